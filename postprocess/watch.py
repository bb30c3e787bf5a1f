#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows a run in a browser of this machine while it goes on: the page of report.py, with what is new as it comes.

    postprocess/watch.py out/hopper             prints an address, and opens it where there is a screen

Only this machine answers, at a free port, and only to who knows the address. Ctrl-C ends it; the run goes on.
Exit codes: 0 done, 2 wrong arguments or something missing, 4 no port can be opened.
"""
import argparse
import hmac
import os
import secrets
import sys
import threading
import time
import webbrowser
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlsplit

try:
    import numpy  # noqa: F401  whether it is there
    import vtkmodules.vtkIOXML  # noqa: F401
except ImportError as error:
    print(f"watch.py: {error}: apt install python3-vtk9 python3-numpy, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)

from read_run import Run, RunError
from run_page.page import RunPage, as_json, html_page, report_body, status_of

AFTER_THE_END = 8.0  # s in which a page can fetch the end of a run before this program ends with it
NICENESS = 10  # the run goes first


class Watched:
    """A run, looked at again when its files have changed."""

    def __init__(self, run):
        self.run = run
        self.page = RunPage(run, live=True)
        self.lock = threading.Lock()  # browsers may ask at the same time
        self.version, self.data, self.blobs = None, None, {}
        self.told_the_end = False

    def state(self):
        """What the page is made of now, as a text that changes with it."""
        marks = [status_of(self.run)]
        for name in ("particles.pvd", "contacts.pvd", "metrics.csv", "summary.json"):
            try:
                found = (self.run.folder / name).stat()
                marks.append(f"{found.st_mtime_ns:x}.{found.st_size:x}")
            except OSError:
                marks.append("")
        return "-".join(marks)

    def refresh(self):
        """Data and blobs as of now."""
        with self.lock:
            version = self.state()
            if version != self.version:
                self.data, self.blobs = self.page.update()
                self.data["version"] = self.version = version
            self.told_the_end |= self.data["status"] != "running"
            return self.data, self.blobs


def handler_for(watched, token):
    """The class that answers; every address begins with the token."""

    class Handler(BaseHTTPRequestHandler):
        server_version, sys_version = "Talus", ""

        def do_GET(self):
            address = urlsplit(self.path)
            _, given, *rest = address.path.split("/", 2) + [""]
            if not hmac.compare_digest(given.encode(), token.encode()):
                return self.answer(404, "text/plain", b"")
            try:
                self.answer_to(rest[0], parse_qs(address.query))
            except (RunError, OSError) as error:
                self.answer(503, "text/plain; charset=utf-8", str(error).encode())

        def answer_to(self, name, query):
            if name == "":
                data, blobs = watched.refresh()
                body = report_body(data, None)
                page = html_page(f"{data['title']} · Talus", body, data, blobs, mode="watch")
                self.answer(200, "text/html; charset=utf-8", page.encode())
            elif name == "run.json":
                data, _ = watched.refresh()
                known = query.get("after") == [data["version"]]
                self.answer(204 if known else 200, "application/json", b"" if known else as_json(data).encode())
            elif name.startswith("blob/") and name.removeprefix("blob/") in watched.blobs:
                self.answer(200, "application/octet-stream", watched.blobs[name.removeprefix("blob/")])
            else:
                self.answer(404, "text/plain", b"")

        def answer(self, status, kind, content):
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(content)))
            self.send_header("Cache-Control", "no-store")
            self.send_header("Referrer-Policy", "no-referrer")
            self.send_header("X-Content-Type-Options", "nosniff")
            self.end_headers()
            try:
                self.wfile.write(content)
            except (BrokenPipeError, ConnectionResetError):  # the page was closed
                pass

        def log_message(self, *_):
            pass

    return Handler


def serve_until_it_is_over(server, watched):
    """Serves until the run has ended, and a page that is open knows."""
    threading.Thread(target=server.serve_forever, daemon=True).start()
    while status_of(watched.run) == "running":
        time.sleep(0.2)
    if watched.data is None:  # nobody looked
        return
    over = time.monotonic() + AFTER_THE_END
    while not watched.told_the_end and time.monotonic() < over:
        time.sleep(0.2)
    time.sleep(2.0)  # in which the page fetches what that named


def main():
    parser = argparse.ArgumentParser(prog="watch.py", description="Shows a run in a browser while it goes on.")
    parser.add_argument("run", metavar="OUT", help="the folder of a run")
    parser.add_argument("--until-it-is-over", action="store_true", help="end with the run")
    arguments = parser.parse_args()
    try:
        watched = Watched(Run(arguments.run))
    except RunError as error:
        print(f"watch.py: {error}", file=sys.stderr)
        sys.exit(2)
    except OSError as error:
        print(f"watch.py: {error.filename}: {error.strerror}.", file=sys.stderr)
        sys.exit(4)
    token = secrets.token_urlsafe(16)
    try:
        server = ThreadingHTTPServer(("127.0.0.1", 0), handler_for(watched, token))
    except OSError as error:
        print(f"watch.py: no port of this machine can be opened: {error.strerror}.", file=sys.stderr)
        sys.exit(4)
    server.daemon_threads = True
    address = f"http://127.0.0.1:{server.server_address[1]}/{token}/"
    print(f"watch: {address}", flush=True)
    os.nice(NICENESS)
    if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        webbrowser.open(address)
    try:
        if arguments.until_it_is_over:
            serve_until_it_is_over(server, watched)
        else:
            server.serve_forever()
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
