"""Runs natator-sim for a case and says what is wrong with how it went: the errors of a case are the texts of Fault."""
import json
import os
import re
import select
import struct
import subprocess
import tempfile
import time
from random import Random


class Fault(Exception):
    """What a case must not do."""


SANITIZER = ("ERROR: AddressSanitizer", "ERROR: LeakSanitizer", "runtime error:", "SUMMARY: ")


def refuse_constant(text):
    raise Fault(f"a number that is none in an answer: {text}")


def parse(text, nulls):
    """JSON without NaN and infinities, and with null only at the keys of `nulls` (None: anywhere) and inside overrides, which are patches."""
    try:
        value = json.loads(text, parse_constant=refuse_constant)
    except (ValueError, RecursionError) as error:
        raise Fault(f"an answer that is no JSON ({error}): {text[:300]}") from None
    check_values(value, nulls, "", text)
    return value


def check_values(value, nulls, key, text):
    if isinstance(value, dict):
        for name, one in value.items():
            if name != "overrides":
                check_values(one, nulls, name, text)
    elif isinstance(value, list):
        for one in value:
            check_values(one, nulls, key, text)
    elif value is None and nulls is not None and key not in nulls or isinstance(value, float) and value - value != 0:
        raise Fault(f"{value} at {key} in {text[:300]}")


def encode(text):
    """Bytes that were no UTF-8 as they were; what JSON calls half a surrogate pair as the three bytes of it."""
    return b"".join(c.encode("utf-8", "surrogateescape" if "\udc80" <= c <= "\udcff" else "surrogatepass") for c in text)


def check_end(code, errors):
    """How a program may end on any input: documented code, one line for what it refuses, nothing from a sanitizer."""
    for sign in SANITIZER:
        if sign in errors:
            raise Fault(f"sanitizer: {errors[errors.index(sign):][:1500]}")
    if code < 0:
        raise Fault(f"ended by signal {-code}: {errors[-500:]}")
    if code not in (0, 2, 3):
        raise Fault(f"exit code {code}: {errors[-500:]}")
    if code and len(errors.strip("\n").split("\n")) != 1:
        raise Fault(f"exit code {code} with {len(errors.splitlines())} lines on standard error: {errors[:500]}")


class Once:
    """A process for each case. The text is its standard input, or a file that is its last argument."""

    def __init__(self, program, arguments, limit, as_file=False, nulls=("id", "distance"), echoes=False):
        self.command, self.limit, self.as_file, self.nulls = [program, *arguments], limit, as_file, nulls
        self.echoes = echoes  # the answer holds the input as well, with the nulls that it has

    def run(self, text):
        with tempfile.TemporaryDirectory(prefix="natator-fuzz-") as folder:
            command, given = self.command, encode(text)
            if self.as_file:
                path = os.path.join(folder, "case.json")
                with open(path, "wb") as file:
                    file.write(given)
                command, given = [*command, path], b""
            try:
                done = subprocess.run(command, input=given, capture_output=True, timeout=self.limit)
            except subprocess.TimeoutExpired:
                raise Fault(f"no end within {self.limit} s") from None
        check_end(done.returncode, done.stderr.decode("utf-8", "replace"))
        out = done.stdout.decode("utf-8", "strict")
        if done.returncode == 0 and not out.strip():
            raise Fault("exit code 0 without an answer")
        if out.strip():
            parse(out, None if self.echoes and "null" in text else self.nulls)

    def close(self):
        pass


class Run:
    """A process for each case, which writes files: the text is JSON of its arguments and of the files that it finds. What it
    would write is there before, and is as it was when the arguments are refused."""

    OUTPUTS, BEFORE = ("path.csv", "fluid.csv"), "what was computed before\n"
    # For what may end with 1 beside a failure of the machine.
    FAILURES = ("cannot be written", "no snapshot: the run ended at ")

    def __init__(self, program, limit):
        self.program, self.limit = program, limit

    def run(self, text):
        case = json.loads(text)
        # exec takes no zero bytes
        arguments = [encode(one.replace("\0", "")) for one in case["arguments"]]
        with tempfile.TemporaryDirectory(prefix="natator-fuzz-") as folder:
            for name, content in (case["files"] | dict.fromkeys(self.OUTPUTS, self.BEFORE)).items():
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(encode(content))
            try:
                done = subprocess.run([self.program, *arguments], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                                      timeout=self.limit)
            except subprocess.TimeoutExpired:
                raise Fault(f"no end within {self.limit} s") from None
            self.check(done, arguments, folder)

    def check(self, done, arguments, folder):
        code = done.returncode
        errors = re.sub(r"natator-sim: backend auto: .*; using the CPU\n", "", done.stderr.decode("utf-8", "replace"))
        known = any(text in errors for text in self.FAILURES)
        check_end(2 if code == 1 and known else 0 if code == 4 else code, errors)
        out = done.stdout.decode("utf-8", "strict")
        if code in (0, 3) and not out.strip():
            raise Fault(f"exit code {code} without an answer")
        if re.search(r"\b(nan|inf|NaN|Infinity)\b", out.split("Usage:")[0]):
            raise Fault(f"a number that is none in the summary: {out[:500]}")
        for name in os.listdir(folder):
            if not name.endswith(".csv"):
                continue
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                content = file.read()
            if content != self.BEFORE:
                if code in (2, 4):
                    raise Fault(f"exit code {code} and {name} was written: {errors[-300:]}")
                check_table(name, content)

    def close(self):
        pass


TABLES = ("frame,time,slice,x,y,z", "frame,time,particle,x,y,z", "time,kind,mass,x,y,z,vx,vy,vz,density")


def check_table(name, content):
    """One table of a form that is documented, whose numbers are finite but for the mass of what is held in place."""
    head, *rows = content.split("\n")
    if head not in TABLES or not content.endswith("\n"):
        raise Fault(f"no whole table in {name}: {content[:200]!r}")
    columns = head.split(",")
    for row in rows[:-1]:
        fields = row.split(",")
        if len(fields) != len(columns):
            raise Fault(f"a row of {name} that does not fit its head: {row[:200]!r}")
        for column, field in zip(columns, fields):
            if column == "kind" and field in ("body", "fluid") or column == "mass" and field == "inf":
                continue
            try:
                value = float(field)
            except ValueError:
                raise Fault(f"{field!r} at {column} in {name}") from None
            if value - value != 0:
                raise Fault(f"{field} at {column} in {name}: {row[:200]}")


class Resident:
    """A process that takes one case after another; started anew when it ended or had `most` cases."""

    def __init__(self, command, limit, most):
        self.command, self.limit, self.most = command, limit, most
        self.process, self.cases, self.buffer, self.before = None, 0, b"", []

    def start(self):
        if self.process and self.cases < self.most:
            return
        self.close()
        self.errors = tempfile.TemporaryFile()
        self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors)
        os.set_blocking(self.process.stdin.fileno(), False)
        self.cases, self.buffer, self.before = 0, b"", []

    def close(self):
        """Ends the process by the end of its input, as a user of it does; anything but 0 is a fault."""
        if not self.process:
            return
        process, self.process = self.process, None
        try:
            process.communicate(timeout=self.limit)
        except subprocess.TimeoutExpired:
            raise Fault(f"no end within {self.limit} s of the end of the input") from None
        finally:
            process.kill()
            process.wait()
        self.check(process)

    def check(self, process):
        self.errors.seek(0)
        errors = self.errors.read().decode("utf-8", "replace")
        check_end(process.returncode, errors)
        if process.returncode:
            raise Fault(f"exit code {process.returncode}: {errors[-500:]}")

    def kill(self):
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process = None

    def exchange(self, given, finished):
        """Writes while it reads, until finished(buffer) is not None; that is returned."""
        end = time.monotonic() + self.limit
        while True:
            result = finished()
            if result is not None:
                return result
            left = end - time.monotonic()
            if left <= 0:
                raise Fault(f"no answer within {self.limit} s")
            stdin, stdout = self.process.stdin, self.process.stdout
            readable, writable, _ = select.select([stdout], [stdin] if given else [], [], left)
            if writable:
                try:
                    given = given[os.write(stdin.fileno(), given[:65536]):]
                except BrokenPipeError:
                    given = b""
            if readable:
                more = os.read(stdout.fileno(), 1 << 20)
                if not more:
                    process, self.process = self.process, None
                    process.wait()
                    self.check(process)
                    raise Fault("it ended before it answered")
                self.buffer += more


class Serve(Resident):
    """Requests, one at a time; a request that is refused at once marks where the answers to the one before it end."""

    def __init__(self, program, limit):
        super().__init__([program, "serve", "--batch", "1"], limit, 500)

    def run(self, text):
        self.start()
        self.cases += 1
        self.before.append(text)
        mark = 9_000_000_000_000_000 + self.cases
        given = encode(text) + b"\n" + b'{"id":%d}\n' % mark
        answers = []

        def finished():
            while b"\n" in self.buffer:
                line, self.buffer = self.buffer.split(b"\n", 1)
                answer = parse(line.decode("utf-8", "strict"), ("id", "distance"))
                if answer.get("id") == mark:
                    return answers
                answers.append(answer)
            return None

        self.exchange(given, finished)
        expected = 1 if text.strip(" \t\r") else 0
        if len(answers) != expected:
            raise Fault(f"{len(answers)} answers to {expected} requests")


class Stream(Resident):
    """Commands of a stream, a few a case; the last is ours and marks the end of the answers. The last state that it gave goes back to
    it, whole or damaged, and with it actions that mean nothing."""

    def __init__(self, program, limit):
        command = [program, "stream", "bench/small-tank", "--overrides", '{"settling":{"updates":2}}', "--paused",
                   "--rate", "0", "--fields", "position,velocity,density"]
        super().__init__(command, limit, 100)
        self.state = b""

    def run(self, text):
        self.start()
        self.cases += 1
        self.before.append(text)
        mark = 9_000_000_000_000_000 + self.cases
        commands = [line for line in text.split("\n") if line.strip(" \t\r")]
        given = b"".join(encode(line) + b"\n" for line in text.split("\n"))
        given += self.messages()
        commands += [""] * 2
        given += b'{"do":"pause"}\n{"do":"credit","frames":1,"id":%d}\n' % mark
        answers = []

        def finished():
            while len(self.buffer) >= 8:
                name, length = self.buffer[:4], struct.unpack_from("<I", self.buffer, 4)[0]
                if len(self.buffer) < 8 + length:
                    return None
                body, self.buffer = self.buffer[8:8 + length], self.buffer[8 + length:]
                if name == b"FRAM":
                    check_frame(body)
                elif name == b"WATR":
                    check_water(body)
                elif name == b"STAT":
                    self.state = body
                elif name == b"OBSV":
                    check_outcomes(body)
                    answers.append(None)
                elif name in (b"SCEN", b"SENS", b"STOP"):
                    parse(body.decode("utf-8", "strict"), ("mass", "skin", "start"))
                elif name == b"ANSW":
                    answer = parse(body.decode("utf-8", "strict"), ("id",))
                    if answer["id"] == mark:
                        return answers
                    answers.append(answer)
                else:
                    raise Fault(f"a message {name!r}")
            return None

        self.exchange(given, finished)
        if len(answers) != len(commands) + 1:
            raise Fault(f"{len(answers) - 1} answers to {len(commands)} commands")


    def messages(self):
        """A state and an order to go to it; and actions, each of which has one message for an answer."""
        random, bodies = Random(self.cases), []
        for body in (self.state, struct.pack("<6I4d", self.cases, 1, random.randrange(5), random.randrange(3), 2, 2, 0.5, -1, 0, 1)):
            body = bytearray(body)
            if random.random() < 0.5 and body:
                body[random.randrange(len(body))] ^= 1 << random.randrange(8)
            bodies.append(bytes(body[:random.randrange(len(body) + 1)] if random.random() < 0.2 else body))
        state, actions = (letters + struct.pack("<I", len(body)) + body for letters, body in zip((b"STAT", b"ACTS"), bodies))
        return state + b'{"do":"restore"}\n' + actions


def check_outcomes(body):
    """One swim's; of its senses only what there may be none of is not finite: work, target."""
    swims, status, count = struct.unpack_from("<III", body, 4)
    if swims != 1 or status > 3:
        raise Fault(f"{swims} swims, status {status}")
    values = struct.unpack_from(f"<{count}d", body, 16)
    check_finite("the senses", [value for k, value in enumerate(values) if k not in (4, 23, 24, 25, 26)], b"")
    parse(body[16 + 8 * count:].decode("utf-8", "strict"), ())


def check_frame(body):
    """All numbers of a frame are finite."""
    check_finite("a frame", struct.unpack_from("<3d", body, 16), body[40:])


def check_water(body):
    """As many cells as it says; all numbers are finite."""
    x, y, z, pressed = struct.unpack_from("<4I", body, 8)
    if pressed > 1 or len(body) != 64 + (16 + 4 * pressed) * x * y * z:
        raise Fault(f"{len(body)} bytes of {x} x {y} x {z} cells")
    check_finite("the water", struct.unpack_from("<5d", body, 24), body[64:64 + 16 * x * y * z])  # of the pressure some are not known


def check_finite(what, doubles, floats):
    for value in (*doubles, sum(struct.unpack(f"<{len(floats) // 4}f", floats))):
        if value - value != 0:
            raise Fault(f"a number in {what} that is not finite")
