def find_blooms(mission, results) -> bool:
    return len(results.new) > 3
