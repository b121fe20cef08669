"""Bugs planted one at a time: which test catches each, how soon, and which does nobody catch?"""
