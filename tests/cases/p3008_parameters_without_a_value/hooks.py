def pollinate(drone, trip, context, often, *, dose, wait, slow=False):
    return dose
