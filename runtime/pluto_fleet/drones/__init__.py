"""Flying real drones: the navigation protocol, its errors, and a team of drones."""

from __future__ import annotations

from ..shared.domain.model import Photo as Photo
from ..shared.domain.model import Point as Point
from ..shared.domain.model import Sighting as Sighting
from .protocol import ACTS_BY_ITSELF as ACTS_BY_ITSELF
from .protocol import BATTERY_LOW as BATTERY_LOW
from .protocol import CRASHED as CRASHED
from .protocol import LINK_LOST as LINK_LOST
from .protocol import LOCKED as LOCKED
from .protocol import POSITION_LOST as POSITION_LOST
from .protocol import ActionNotDone as ActionNotDone
from .protocol import Acts as Acts
from .protocol import ActsOnTheWay as ActsOnTheWay
from .protocol import BatteryLow as BatteryLow
from .protocol import CaredFor as CaredFor
from .protocol import Crashed as Crashed
from .protocol import DroneEvent as DroneEvent
from .protocol import DroneNavigation as DroneNavigation
from .protocol import DroneSetup as DroneSetup
from .protocol import DroneTelemetry as DroneTelemetry
from .protocol import Follows as Follows
from .protocol import Identifiable as Identifiable
from .protocol import LinkLost as LinkLost
from .protocol import Locatable as Locatable
from .protocol import Locked as Locked
from .protocol import NavigationError as NavigationError
from .protocol import NotReady as NotReady
from .protocol import OutsideArea as OutsideArea
from .protocol import PositionLost as PositionLost
from .protocol import Readable as Readable
from .protocol import Rejected as Rejected
from .protocol import Scannable as Scannable
from .protocol import Sees as Sees
from .protocol import TargetTimeout as TargetTimeout
from .telemetry import Reports as Reports
from .tracking import Track as Track
