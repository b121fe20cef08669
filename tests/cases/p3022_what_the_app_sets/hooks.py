def sniff(drone, trip, context):
    context.emit("smoke", mission=trip.name)


def look_after(event, context):
    return None
