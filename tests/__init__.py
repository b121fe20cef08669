"""The tests, and the campaigns that are run as `python -m tests.…`: in each the brain is one."""

from tests.one_brain import share_one_brain

share_one_brain()
