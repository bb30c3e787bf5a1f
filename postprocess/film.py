# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames into a film, through Debian's ffmpeg."""
import os
import shutil
import subprocess

from read_run import RunError

# By the ending of the file: how ffmpeg makes it. Sizes must be even for the first two.
ENCODERS = {
    ".mp4": ["-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"],
    ".webm": ["-c:v", "libvpx-vp9", "-crf", "30", "-b:v", "0", "-row-mt", "1", "-pix_fmt", "yuv420p", "-f", "webm"],
    ".gif": ["-filter_complex", "split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=bayer:bayer_scale=4",
             "-f", "gif"],
}


def require_ffmpeg():
    """Raises RunError where there is none."""
    if not shutil.which("ffmpeg"):
        raise RunError("There is no ffmpeg to make a film with: apt install ffmpeg.")


class Film:
    """A film that grows frame by frame, and has its name when it is whole.

    Raises OSError where it cannot be written.
    """

    def __init__(self, path, size, rate):
        self.path = path
        self.unfinished = path.with_name(f".{path.name}.unfinished")
        self.unfinished.touch()  # what forbids it is reported here, in the words of the system
        command = ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}",
                   "-r", f"{rate:g}", "-i", "-", *ENCODERS[path.suffix.lower()], str(self.unfinished)]
        self.ffmpeg = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)

    def __enter__(self):
        return self

    def add(self, pixels):
        """pixels: rows from above, of red, green, blue."""
        try:
            self.ffmpeg.stdin.write(pixels.tobytes())
        except BrokenPipeError:
            self._end()

    def __exit__(self, kind, *_):
        if kind is not None:
            self.ffmpeg.kill()
            self.ffmpeg.wait()
            self.unfinished.unlink(missing_ok=True)
            return
        self._end()
        os.replace(self.unfinished, self.path)

    def _end(self):
        """Raises RunError with what ffmpeg complains of."""
        _, complaint = self.ffmpeg.communicate()
        if self.ffmpeg.returncode:
            self.unfinished.unlink(missing_ok=True)
            last = complaint.decode(errors="replace").strip().splitlines()[-1:] or ["it does not say why"]
            raise RunError(f"ffmpeg could not make {self.path}: {last[0]}")
