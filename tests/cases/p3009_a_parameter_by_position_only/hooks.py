def pollinate(drone, trip, context, dose, /):
    return dose
