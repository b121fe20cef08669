async def limit_trip(mission, context, *, limits=3.0):
    return None
