#!/usr/bin/env python3
"""Serves a folder on 127.0.0.1, isolated from other sites, so that its pages may use threads.

    tools/serve.py FOLDER [PORT]
"""

import contextlib
import functools
import http.server
import sys


class Isolated(http.server.SimpleHTTPRequestHandler):
    def end_headers(self):
        self.send_header("Cross-Origin-Opener-Policy", "same-origin")
        self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
        super().end_headers()


folder, port = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 8000
handler = functools.partial(Isolated, directory=folder)
with http.server.ThreadingHTTPServer(("127.0.0.1", port), handler) as server:
    with contextlib.suppress(KeyboardInterrupt):
        server.serve_forever()
