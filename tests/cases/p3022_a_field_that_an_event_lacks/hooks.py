def sniff(drone, trip, context):
    context.emit("smoke", thickness=0.4)


def look_after(event, context):
    return None
