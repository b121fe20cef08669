"""The same flow, written as its users would write it today: one contender a file.

Each is a program of its own (`python -m contenders.ideal`, from this folder): it does the work of
`work.py`, which checks what came of it, and prints one line of JSON.
"""
