def find_blooms(mission, results):
    yield from results.new
