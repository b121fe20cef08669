def spray(drone, trip, context, *, dose: str):
    context.log("sprayed " + dose)
