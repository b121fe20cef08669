class find_blooms:
    pass
