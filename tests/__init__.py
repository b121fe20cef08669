"""The tests, and the campaigns that are run as `python -m tests.…`: in each the brain is one."""

import os

from tests.one_brain import share_one_brain

if "PLUTO_EMBEDDED" not in os.environ:  # there the runtime is what one app carries
    share_one_brain()
