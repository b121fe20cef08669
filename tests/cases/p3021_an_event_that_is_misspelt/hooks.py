def sniff(drone, trip, context):
    context.emit("smok")


def look_after(event, context):
    return None  # `smoke` alone is no reason to fly
