#!/usr/bin/env python3
"""window_test.py RELIEVO FOLDER: the built program in a real window, on a virtual display and software Vulkan.

What the window shows is compared with what `relievo render` writes: the picture must be the same, whoever draws it.
Exit code 77 where there is no Xvfb.
"""
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

PROGRAM = SCRATCH = None
MATERIAL = ["--material", "cobbles", "--texels", "128"]
SIZE = (960, 560)
DISPLAY = None  # of the virtual screen, ":7"


class VirtualScreen:
    """An Xvfb of our own for the whole test. xvfb-run ends with a code of its own when the server still writes into the folder it
    removes ("problem while cleaning up temporary directory"), which hides the program's."""

    def __enter__(self):
        readable, writable = os.pipe()
        # -noreset: the server stays as it is when the last window closes, instead of starting over beside the next program.
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writable), "-screen", "0", "1400x1000x24", "-nolisten", "tcp", "-noreset"],
                                       pass_fds=[writable], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        os.close(writable)
        with os.fdopen(readable) as number:
            display = number.readline().strip()  # written when the screen is ready, closed without a line when it cannot be
        if not display:
            raise RuntimeError("Xvfb did not start: " + self.server.communicate()[1])
        return ":" + display

    def __exit__(self, *_):
        self.server.terminate()
        self.server.communicate()


def read_png(path):
    """Width, height and rows of RGB bytes of an 8-bit RGB or RGBA file; by hand, so that nothing need be installed."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            assert bits == 8 and colour in (2, 6), (bits, colour)
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    texel = 3 if colour == 2 else 4
    raw = zlib.decompress(packed)
    before = bytearray(width * texel)
    rows = []
    for y in range(height):
        begin = y * (width * texel + 1)
        method, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + width * texel])
        for i in range(len(row)):
            left = row[i - texel] if i >= texel else 0
            up = before[i]
            corner = before[i - texel] if i >= texel else 0
            if method == 1:
                row[i] = (row[i] + left) & 255
            elif method == 2:
                row[i] = (row[i] + up) & 255
            elif method == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif method == 4:
                p = left + up - corner
                a, b, c = abs(p - left), abs(p - up), abs(p - corner)
                row[i] = (row[i] + (left if a <= b and a <= c else up if b <= c else corner)) & 255
        before = row
        rows.append(bytes(row) if texel == 3 else bytes(v for i, v in enumerate(row) if i % 4 != 3))
    return width, height, rows


def environment(**changes):
    env = dict(os.environ)
    env.pop("WAYLAND_DISPLAY", None)
    env.update(changes)
    return env


def run(*arguments, display=True):
    env = environment(DISPLAY=DISPLAY)
    if not display:
        env.pop("DISPLAY")
    return subprocess.run([PROGRAM, *arguments], env=env, capture_output=True, text=True, timeout=240)


class Window(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(dir=SCRATCH)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def view(self, name, *arguments, frames=5, size=SIZE):
        """The window's last frame, after a run without a message of the validation layers."""
        done = run("view", *MATERIAL, "--device", "software", "--validation", "--size", "%dx%d" % size, "--frames", str(frames),
                   "--screenshot", self.path(name), *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("alidation", done.stderr)
        shown = read_png(self.path(name))
        self.assertEqual(shown[:2], size)
        return shown

    def drawn(self, name, technique, width, height, *arguments):
        done = run("render", *MATERIAL, "--device", "software", "--technique", technique, "--samples", "1", "--size",
                   "%dx%d" % (width, height), "--out", self.path(name), *arguments, display=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return read_png(self.path(name))

    def panel(self, shown):
        """Width of the panel: the picture begins where the first row is no longer the panel's grey."""
        grey = shown[2][0][:3]
        self.assertLess(max(grey), 60, "the panel is dark")
        row = shown[2][0]
        return next(x for x in range(shown[0]) if row[3 * x:3 * x + 3] != grey)

    def assert_same(self, shown, drawn, left, begin, end, rows):
        """Columns begin to end of the drawn picture stand in the window, from column `left` on."""
        worst = different = 0
        for y in rows:
            a = shown[2][y][3 * (left + begin):3 * (left + end)]
            b = drawn[2][y][3 * begin:3 * end]
            if a == b:
                continue
            for p, q in zip(a, b):
                worst = max(worst, abs(p - q))
                different += abs(p - q) > 1
        # The device encodes colours when it writes them, the PNG writer in software: they round alike but for ties. Edges of
        # stones may fall on either side where reference rays of the window and of the picture differ in the last bit.
        self.assertLessEqual(different, 3 * len(rows) * (end - begin) * 0.001, "worst %d" % worst)

    def test_shows_the_picture_that_render_draws(self):
        shown = self.view("plain.png")
        left = self.panel(shown)
        self.assertLessEqual(left, SIZE[0] // 2)
        drawn = self.drawn("drawn.png", "relief_mapping", SIZE[0] - left, SIZE[1])
        self.assert_same(shown, drawn, left, 0, SIZE[0] - left, range(SIZE[1]))
        self.assertGreater(len({drawn[2][y][3 * x:3 * x + 3] for y in range(0, SIZE[1], 7) for x in range(0, SIZE[0] - left, 7)}), 500,
                           "the material is in the picture")
        letters = sum(min(shown[2][y][3 * x:3 * x + 3]) > 150 for y in range(SIZE[1]) for x in range(left))
        self.assertGreater(letters, 1000, "the panel has text")

    def test_split_shows_the_technique_and_the_reference(self):
        shown = self.view("split.png", "--split", "--technique", "parallax_mapping", "--view", "grazing")
        left = self.panel(shown)
        width = SIZE[0] - left
        rows = range(SIZE[1] - 70)  # above the labels
        middle, margin = width // 2, 20  # of the divider's grip
        self.assert_same(shown, self.drawn("technique.png", "parallax_mapping", width, SIZE[1], "--view", "grazing"), left, 0, middle - margin, rows)
        self.assert_same(shown, self.drawn("reference.png", "reference", width, SIZE[1], "--view", "grazing"), left, middle + margin, width, rows)

    def test_every_technique_draws_without_a_message(self):
        listed = subprocess.run([PROGRAM, "list", "techniques", "--json"], capture_output=True, text=True, check=True).stdout
        import json
        table = json.loads(listed)
        table = table if isinstance(table, list) else table["techniques"]
        for technique in table:
            with self.subTest(technique["id"]):
                self.view("one.png", "--technique", technique["id"], frames=1, size=(480, 300))

    def test_windows_of_any_size(self):
        for size in ((1, 1), (37, 300), (1200, 40)):
            with self.subTest(size):
                self.view("odd.png", "--split", frames=2, size=size)

    def test_without_a_display(self):
        done = run("view", *MATERIAL, "--frames", "1", "--screenshot", self.path("none.png"), display=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("cannot open a window", done.stderr)
        self.assertIn("DISPLAY", done.stderr)
        self.assertIn("xvfb-run", done.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_refuses_what_cannot_work(self):
        for code, said, arguments in (
                (1, "no-such-folder", ["--screenshot", self.path("no-such-folder/a.png")]),
                (2, ".png", ["--screenshot", self.path("a.jpg")]),
                (1, "no usable device", ["--device", "abacus"]),
                (1, "no such folder", ["--material", "/no/such/place"])):
            with self.subTest(arguments):
                done = run("view", "--texels", "32", "--frames", "1", *arguments)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertIn(said, done.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def started(self, script):
        """A shell on a virtual display, in which the program runs until the script lets it end."""
        return subprocess.run(["sh", "-c", script], env=environment(DISPLAY=DISPLAY, PROGRAM=PROGRAM, OUT=self.path("last.png")),
                              capture_output=True, text=True, timeout=240)

    def test_an_interruption_leaves_nothing(self):
        # `exec` in a process group of its own: a shell's background jobs ignore SIGINT unless they say otherwise.
        done = self.started('''python3 -c "import os, signal, sys; signal.signal(signal.SIGINT, signal.SIG_DFL); os.execv(sys.argv[1], sys.argv[1:])" \
            "$PROGRAM" view --material cobbles --texels 64 --device software --split --screenshot "$OUT" & pid=$!
            sleep 4; kill -INT $pid; wait $pid''')
        self.assertEqual(done.returncode, 130, done.stderr)
        self.assertIn("interrupted", done.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    @unittest.skipUnless(shutil.which("xdotool"), "xdotool is not installed")
    def test_follows_the_window_and_the_hand(self):
        done = self.started('''"$PROGRAM" view --material cobbles --texels 64 --device software --validation --split --screenshot "$OUT" & pid=$!
            window=$(xdotool search --sync --onlyvisible --name "^relievo" | head -1)
            sleep 1
            for size in "700 400" "300 200" "1100 640"; do xdotool windowsize $window $size; sleep 0.7; done
            xdotool mousemove --window $window 700 300 mousedown 1 mousemove_relative --sync 60 40 mouseup 1
            xdotool mousemove --window $window 900 300 mousedown 3 mousemove_relative --sync 60 40 mouseup 3
            xdotool mousemove --window $window 900 300 click 4 click 4
            xdotool key --window $window Down; sleep 0.5
            xdotool key --window $window Escape
            wait $pid''')
        self.assertEqual(done.returncode, 0, done.stderr)
        shown = read_png(self.path("last.png"))
        self.assertEqual(shown[:2], (1100, 640))


if __name__ == "__main__":
    PROGRAM, SCRATCH = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    if not shutil.which("Xvfb"):
        print("skipped: Xvfb is not installed (package xvfb)")
        sys.exit(77)
    os.makedirs(SCRATCH, exist_ok=True)
    with VirtualScreen() as DISPLAY:
        unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
