"""Coroutines and time: one kernel, driven by a virtual clock or by the wall's."""
