async def by_battery(trip, candidates):
    return max(candidates, key=lambda drone: drone.battery_level)
