"""The recording in a run's report.html: docs/RECORDING.md has its format."""
import base64
import json
import re
import zlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy
import pandas

from .folder import NotAReport

ENTERING = numpy.dtype([("id", "<u4"), ("lot", "<u2"), ("radius_m", "<f4"), ("start_m", "<f4", 3)])


@dataclass(frozen=True)
class Frame:
    """The grains and vessels at one time, in the lab: x along, y up, z across."""
    time_s: float
    vessels: pandas.DataFrame  # by name: x_m, y_m, z_m of the frame's zero and angle_rad; own point p lies at (x, y) + R(angle) p
    grains: pandas.DataFrame  # by id: lot (its number), radius_m, x_m, y_m, with clumps angle_rad; in space z_m, with clumps qw .. qz


class Recording:
    """Frames of a run, in order: `for frame in recording`. `len(recording)` of them, places rounded to `unit_m`."""

    def __init__(self, page):
        """`page`: path of a report.html. NotAReport where it holds no recording."""
        found = re.search(r'<script id="recording"[^>]*>([A-Za-z0-9+/=]*)</script>', Path(page).read_text(encoding="utf-8"))
        data = base64.b64decode(found[1]) if found else b""
        if data[:8] != b"VBSWREC1":
            raise NotAReport(f"{page} holds no recording")
        end = 12 + int.from_bytes(data[8:12], "little")
        self.header, self._blocks = json.loads(data[12:end]), data[end:]

    unit_m = cached_property(lambda self: self.header["unit_m"])

    def __len__(self):
        return self.header["frames"]

    def __iter__(self):
        for block in self.header["blocks"]:
            packed = self._blocks[block["offset"]:block["offset"] + block["bytes"]]
            yield from self._frames(zlib.decompress(packed), block["frames"])

    def _frames(self, data, count):
        at = 0

        def take(dtype, number):
            nonlocal at
            values = numpy.frombuffer(data, dtype, number, at)
            at += values.nbytes
            return values

        fields, vessels = self.header["fields"], self.header["vessels"]
        units = numpy.array(self.header["field_units"])
        names = [{"angle": "angle_rad"}.get(field, field + "_m" if len(field) == 1 else field) for field in fields]
        known = numpy.empty(0, ENTERING)
        last = before = numpy.empty((len(fields), 0), "<i4")
        frames = numpy.empty(0, int)  # that each grain was in so far
        for _ in range(count):
            time = float(take("<f8", 1)[0])
            poses = take("<f8", 4 * len(vessels)).reshape(-1, 4)
            leaving, entering, present = take("<u4", 3)
            staying = numpy.delete(numpy.arange(len(known)), take("<u4", leaving))
            known = numpy.concatenate([known[staying], take(ENTERING, entering)])
            new = numpy.zeros((len(fields), entering), "<i4")
            last, before = (numpy.hstack([values[:, staying], new]) for values in (last, before))
            frames = numpy.concatenate([frames[staying], numpy.zeros(entering, int)])
            planes = take("u1", 4 * present * len(fields)).reshape(len(fields), 4, present).astype("<u4")
            coded = planes[:, 0] | planes[:, 1] << 8 | planes[:, 2] << 16 | planes[:, 3] << 24
            residual = (coded >> 1).astype("<i4") ^ -(coded & 1).astype("<i4")
            now = residual + numpy.where(frames > 1, 2 * last - before, last)
            before, last, frames = last, now, frames + 1
            grains = pandas.DataFrame({"lot": known["lot"].astype(int), "radius_m": known["radius_m"]}, index=pandas.Index(known["id"], name="id"))
            for name, values, unit in zip(names, now, units):
                grains[name] = values * unit
            yield Frame(time, pandas.DataFrame(poses, vessels, ["x_m", "y_m", "z_m", "angle_rad"]), grains)
