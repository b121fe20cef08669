def settle(mission, context, *, rest):
    await context.sleep(rest)
