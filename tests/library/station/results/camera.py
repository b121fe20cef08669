"""A drone of a user's own with a camera: each photo is a real picture, kept where its navigation may."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from PIL import Image
from wren import Wren

from pluto_fleet.drones import DroneSetup, Photo

SIZE = (1200, 900)


class CameraWren(Wren):
    def __init__(self, setup: DroneSetup) -> None:
        super().__init__(setup)
        self.folder, self.name, self.taken = setup.folder, setup.id, 0

    def why_not(self, action: str, parameters: Mapping[str, object]) -> str | None:
        return None if action == "take_photo" else f"{self.name} has nothing but a camera"

    async def act(self, action: str, parameters: Mapping[str, object], item: object) -> Photo:
        self.taken += 1
        file = Path(f"{self.name}-{self.taken}.png")
        colours = Image.linear_gradient("L").resize(SIZE)
        Image.merge("RGB", (colours, colours.rotate(180), colours)).save(self.folder / file)
        x, y, z = self.telemetry.position
        return Photo(position=(x, y, z), width=z * 1.6, height=z * 1.2, file=str(file))
