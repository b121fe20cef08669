from orchard import Mission


def look_after(event: Mission, context) -> Mission | None:
    return None  # `smoke` comes by HTTP
