"""A headless Chromium without network, driven over its DevTools pipe. Standard library only."""

import base64
import json
import os
import select
import subprocess
import time

# No background traffic, no first-run pages, nothing kept, no name resolved.
FLAGS = """--headless --no-sandbox --disable-gpu --disable-dev-shm-usage --hide-scrollbars --no-first-run
--no-default-browser-check --disable-background-networking --disable-component-update --disable-sync --disable-extensions
--disable-default-apps --disable-domain-reliability --disable-breakpad --disable-client-side-phishing-detection --metrics-recording-only
--no-pings --disable-features=OptimizationHints,MediaRouter,DialMediaRouteProvider,Translate,AutofillServerCommunication
--remote-debugging-pipe""".split() + ["--host-resolver-rules=MAP * ~NOTFOUND"]

PATIENCE_s = 30.0


class Chromium:
    """One process and one page; `with Chromium(program, profile) as browser`."""

    def __init__(self, program, profile):
        self.net_log = os.path.join(profile, "net.json")
        command_read, self.command = os.pipe()
        self.answer, answer_write = os.pipe()

        def into_place():  # Chromium reads commands on 3 and answers on 4
            high = [os.dup(fd) for fd in (command_read, answer_write)]
            high = [fd if fd > 4 else os.dup(fd) for fd in high]
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        self.process = subprocess.Popen(
            [program, *FLAGS, f"--user-data-dir={profile}", f"--log-net-log={self.net_log}", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=open(os.path.join(profile, "stderr"), "wb"),
            preexec_fn=into_place, close_fds=False)
        os.close(command_read)
        os.close(answer_write)
        self.buffer, self.last_id, self.events, self.session = b"", 0, [], None

    def __enter__(self):
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        return self

    def __exit__(self, *_):
        self.session = None
        try:
            self.call("Browser.close")
            self.process.wait(PATIENCE_s)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.command)
        os.close(self.answer)

    def message(self):
        """The next one, waited for."""
        until = time.monotonic() + PATIENCE_s
        while b"\0" not in self.buffer:
            left = until - time.monotonic()
            if left <= 0 or not select.select([self.answer], [], [], left)[0]:
                raise RuntimeError("Chromium does not answer")
            part = os.read(self.answer, 1 << 20)
            if not part:
                raise RuntimeError("Chromium ended")
            self.buffer += part
        one, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(one)

    def call(self, method, **parameters):
        self.last_id += 1
        request = {"id": self.last_id, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        data = json.dumps(request).encode() + b"\0"
        while data:
            data = data[os.write(self.command, data):]
        while True:
            message = self.message()
            if message.get("id") == self.last_id:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']['message']}")
                return message["result"]
            if "method" in message:
                self.events.append(message)

    def wait_for(self, method):
        while True:
            for event in self.events:
                if event["method"] == method:
                    return event
            self.events.append(self.message())

    def open(self, url):
        """Loads a page; afterwards `events` holds what happened on the way."""
        self.events = []
        self.call("Page.navigate", url=url)
        self.wait_for("Page.loadEventFired")

    def screen(self, width, height, phone=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)

    def media(self, kind="", scheme="light"):
        self.call("Emulation.setEmulatedMedia", media=kind, features=[{"name": "prefers-color-scheme", "value": scheme}])

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"].get("exception", {}).get("description", "a script failed"))
        return result["result"].get("value")

    def key(self, name, code):
        for kind in ("rawKeyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name, windowsVirtualKeyCode=code)

    def picture(self, whole=True):
        """PNG bytes of the whole page, or of what the window shows."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole)["data"])

    def pdf(self):
        return base64.b64decode(self.call("Page.printToPDF", printBackground=False, preferCSSPageSize=True)["data"])
