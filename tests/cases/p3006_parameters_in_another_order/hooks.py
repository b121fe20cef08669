def pollinate(drone, dose, trip, context):
    return dose


def find_blooms(results, mission):
    return None
