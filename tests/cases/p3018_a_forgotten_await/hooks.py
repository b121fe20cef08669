from . import Context, Drone, Mission, Trip


async def rinse(context: Context) -> None:
    await context.sleep(1.0)


async def pour(drone: Drone, trip: Trip, context: Context, *, amount: float) -> object:
    live = context.live(drone)
    live.write("pump.ml", amount * 1000)
    rinse(context)
    while live.read("pump.left") > 0:
        await context.sleep(0.5)
    context.log(f"{live.read('pump.left')} ml are left")
    poured = live.read("pump.poured")
    return poured


def settle(mission: Mission, context: Context) -> None:
    context.sleep(3.0)


def fullest(trip, candidates):
    rinse(None)
    return candidates[0]
