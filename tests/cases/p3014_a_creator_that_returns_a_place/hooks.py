from orchard import Context, Point, SmokeEvent


async def look_after(event: SmokeEvent, context: Context) -> Point:
    await context.sleep(1.0)
    return event.at  # `smoke` comes by HTTP
