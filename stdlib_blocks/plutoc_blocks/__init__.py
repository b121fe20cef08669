"""The standard blocks, one folder each: the thesis's twelve (4.2), and three of ours."""

from plutoc_blocks.clock import CLOCK
from plutoc_blocks.drone_allocator import DRONE_ALLOCATOR
from plutoc_blocks.event_monitor import EVENT_MONITOR
from plutoc_blocks.gap_monitor import GAP_MONITOR
from plutoc_blocks.gate_fifo import GATE_FIFO
from plutoc_blocks.gate_funnel import GATE_FUNNEL
from plutoc_blocks.mission_creator import MISSION_CREATOR
from plutoc_blocks.mission_evaluator import MISSION_EVALUATOR
from plutoc_blocks.mission_modifier import MISSION_MODIFIER
from plutoc_blocks.mission_repeater import MISSION_REPEATER
from plutoc_blocks.priority_manager import PRIORITY_MANAGER
from plutoc_blocks.timer_monitor import TIMER_MONITOR
from plutoc_blocks.trip_launcher import TRIP_LAUNCHER
from plutoc_blocks.trip_monitor import TRIP_MONITOR
from plutoc_blocks.trip_skipper import TRIP_SKIPPER

BLOCKS = (
    MISSION_CREATOR,
    CLOCK,
    DRONE_ALLOCATOR,
    TRIP_LAUNCHER,
    TRIP_MONITOR,
    TIMER_MONITOR,
    GAP_MONITOR,
    EVENT_MONITOR,
    GATE_FIFO,
    GATE_FUNNEL,
    MISSION_REPEATER,
    MISSION_EVALUATOR,
    MISSION_MODIFIER,
    PRIORITY_MANAGER,
    TRIP_SKIPPER,
)
