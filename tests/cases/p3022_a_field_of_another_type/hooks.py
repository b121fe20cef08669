def sniff(drone, trip, context):
    context.emit("smoke", density="40 %")


def look_after(event, context):
    return None
