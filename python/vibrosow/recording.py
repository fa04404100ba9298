"""The recording in a run's report.html: docs/reference/recording-format.md has its format."""
import base64
import json
import re
import struct
import zlib
from dataclasses import dataclass, replace
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
    contacts: pandas.DataFrame | None = None  # of frames that keep them: grain and partner (ids), force_N, the normal one; of a wall, or across a periodic boundary, partner -1 and the place x_m, y_m, in space z_m


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
        contacts = {entry["frame"]: entry for entry in self.header.get("contacts", [])}
        frames = (frame for block in self.header["blocks"] for frame in self._frames(self._unpacked(block), block["frames"]))
        for number, frame in enumerate(frames):
            yield replace(frame, contacts=self._contacts(self._unpacked(contacts[number]), frame.grains)) if number in contacts else frame

    @cached_property
    def map(self):
        """Means over the measuring window by cell, in the tray's frame, without seeds in the hopper: x_m, y_m of its middle,
        packing_fraction, vx_m_per_s and vy_m_per_s (empty where no seed was). None of a run that ended before its window."""
        return self._map("map")

    @cached_property
    def hopper_map(self):
        """The same of the seeds in the hopper, in its frame. None without any."""
        return self._map("hopper_map")

    def _map(self, name):
        head = self.header.get(name)
        if head is None:
            return None
        packing, vx, vy = numpy.frombuffer(self._unpacked(head), "<f4").reshape(3, -1)
        row, column = numpy.divmod(numpy.arange(packing.size), head["columns"])
        return pandas.DataFrame({"x_m": (column + 0.5) * head["cell_m"], "y_m": (row + 0.5) * head["cell_m"], "packing_fraction": packing,
                                 "vx_m_per_s": vx, "vy_m_per_s": vy})

    def _unpacked(self, entry):
        return zlib.decompress(self._blocks[entry["offset"]:entry["offset"] + entry["bytes"]])

    def _contacts(self, data, grains):
        axes = [axis for axis in self.header["fields"] if len(axis) == 1]
        largest, pairs, touches = struct.unpack_from("<dII", data)
        first = 16 + 9 * pairs

        def numbers(at, count):
            return numpy.frombuffer(data, "u1", 4 * count, at).reshape(4, count).T.astype("<u4") @ [1, 1 << 8, 1 << 16, 1 << 24]

        def forces(at, count):
            return largest * 10 ** (-numpy.frombuffer(data, "u1", count, at) / 64)

        grain, touched = numpy.cumsum(numbers(16, pairs)), numpy.cumsum(numbers(first, touches))
        ids = grains.index.to_numpy().astype("<i8")
        of_two = pandas.DataFrame({"grain": ids[grain], "partner": ids[grain + numbers(16 + 4 * pairs, pairs)],
                                   "force_N": forces(16 + 8 * pairs, pairs)})
        alone = pandas.DataFrame({"grain": ids[touched], "partner": -1, "force_N": forces(first + (4 + len(axes)) * touches, touches)})
        arms = numpy.frombuffer(data, "i1", len(axes) * touches, first + 4 * touches).reshape(len(axes), touches)
        for axis, arm in zip(axes, arms):
            alone[f"{axis}_m"] = grains[f"{axis}_m"].to_numpy()[touched] + arm / 100 * grains["radius_m"].to_numpy()[touched]
        return pandas.concat([of_two, alone], ignore_index=True)

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
