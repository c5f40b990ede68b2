"""Each renderer as programs that are run to their end: what they took, and the picture.

Knows neither what is measured nor why. Nothing of an earlier run helps a later one: `rtc` keeps no cache, and a script
has a home folder of its own, where Dr.Jit would find compiled kernels.
"""

import math
import shutil
import subprocess
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

import mesh_files
import meshes
import to_rts
from processes import Run, run

HERE = Path(__file__).resolve().parent
# Seeds of references; measured pictures take others.
FIRST_SEED = 1000


def read(path):
    if path.suffix == ".npy":
        return np.load(path)
    return np.array(mi.Bitmap(str(path)), dtype=np.float32)[:, :, :3]


class Ours:
    """`rtc`, then `rtr`."""

    key = "rtr"

    def __init__(self, args, work):
        self.rtc, self.rtr = args.rtr_dir / "rtc", args.rtr_dir / "rtr"
        self.work, self.threads = work, args.threads
        said = subprocess.run([self.rtr, "--version"], check=True, capture_output=True, text=True)
        self.name = f"`{said.stdout.strip()}`"

    def compile(self, scene, size):
        """From nothing: no tree is kept."""
        (self.work / f"{scene.name}.rts").write_text(to_rts.text(scene, size))
        command = [self.rtc, self.work / f"{scene.name}.rts", "-o", self.work / f"{scene.name}.pack", "--no-cache"]
        return run(command, self.work)

    def render(self, scene, size, spp, seed):
        out = self.work / "ours.exr"
        command = [self.rtr, self.work / f"{scene.name}.pack", "--device", "cpu", "--quiet", "--threads", self.threads,
                   "--spp", spp, "--seed", seed, "-o", out]
        return run(command, self.work), read(out)

    def reference(self, scene, size, spp, replicate, replicates):
        """One of several pictures without bias; what kind of pictures these are is in `reference_name`."""
        return self.render(scene, size, spp, FIRST_SEED + replicate)[1]

    @property
    def reference_name(self):
        return self.name

    @staticmethod
    def whole(spp):
        """The greatest number of samples up to `spp` that it renders as asked."""
        return max(1, int(spp))


class Peer:
    """A Python script."""

    def __init__(self, args, work):
        self.work, self.threads = work, args.threads

    def compile(self, scene, size):
        """There is nothing to do ahead."""
        return Run(0, 0, 0)

    def render(self, scene, size, spp, seed, more=()):
        home = self.work / "home"
        shutil.rmtree(home, ignore_errors=True)
        home.mkdir()
        out = self.work / f"{self.key}{self.suffix}"
        command = [sys.executable, HERE / self.script, scene.name, self.work, *size, spp, seed, self.threads, out,
                   *more]
        return run(command, home), read(out)


class Mitsuba(Peer):
    key, script, suffix = "mitsuba", "with_mitsuba.py", ".npy"

    def __init__(self, args, work):
        super().__init__(args, work)
        self.variant = args.variant
        self.name = f"Mitsuba {mi.__version__}, `{args.variant}`, `multijitter`"

    def render(self, scene, size, spp, seed, sampler="multijitter"):
        return super().render(scene, size, spp, seed, [self.variant, sampler])

    reference_name = "Mitsuba, `independent`"

    def reference(self, scene, size, spp, replicate, replicates):
        """The means of `multijitter` depend on how many samples there are, whatever the seeds."""
        return self.render(scene, size, spp, FIRST_SEED + replicate, "independent")[1]

    @staticmethod
    def whole(spp):
        """`multijitter` takes n m samples, where n is the root of them rounded down."""
        root = max(1, math.isqrt(int(spp)))
        return root * max(1, int(spp) // root)


class Cycles(Peer):
    key, script, suffix = "cycles", "with_cycles.py", ".exr"

    def __init__(self, args, work):
        super().__init__(args, work)
        # Asked of a process of its own: Blender in this one would take memory for nothing.
        said = subprocess.run([sys.executable, "-c", "import bpy; print(bpy.app.version_string)"], check=True,
                              capture_output=True, text=True)
        self.name = f"Blender {said.stdout.split()[-1]}, Cycles"

    reference_name = "Cycles, one sequence"

    def reference(self, scene, size, spp, replicate, replicates):
        """Parts of one picture: those of few samples are too dark, whatever the seeds."""
        return self.render(scene, size, spp, FIRST_SEED, [replicate * spp, replicates * spp])[1]

    @staticmethod
    def whole(spp):
        return max(1, int(spp))


ALL = (Ours, Mitsuba, Cycles)


def prepare(scene, work):
    """Writes the meshes of a scene."""
    for name in scene.meshes():
        if not (work / f"{name}.glb").exists():
            vertices, triangles = meshes.make(name)
            mesh_files.write_ply(work / f"{name}.ply", vertices, triangles)
            mesh_files.write_glb(work / f"{name}.glb", vertices, triangles)
