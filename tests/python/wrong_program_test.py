"""What the client says of a program that is another, of another version, or dying: an error of its own, and the program has ended."""

import copy
import json
import os
import shlex
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import natator
import natator.gym
from natator.program import simulator_path
from natator.simulator import make_request

TANK = "bench/small-tank"
GAIT = natator.Gait(1.861, [0.973, 0.69], [0, 0.648])
OTHERS = (None, True, -1, 1.5, 10**400, "x", [[]], {"x": 1})  # than what belongs there


def message(letters, body):
    body = body if isinstance(body, bytes) else json.dumps(body).encode()
    body += b" " * (-len(body) % 4)
    return letters + struct.pack("<I", len(body)) + body


def changed(value, depth=3):
    """The same with a key missing, or something else in its place; the keys within, too."""
    keys = list(value) if isinstance(value, dict) else range(min(len(value), 2))
    for key in keys:
        for other in OTHERS:
            copied = copy.copy(value)
            copied[key] = other
            yield f"{key} = {str(other)[:9]}", copied
        copied = copy.copy(value)
        del copied[key]
        yield f"no {key}", copied
        if depth and isinstance(value[key], (dict, list)):
            for name, part in changed(value[key], depth - 1):
                copied = copy.copy(value)
                copied[key] = part
                yield f"{key}.{name}", copied


class WrongProgramTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        with natator.Simulator(1) as simulator:
            cls.results = [simulator.evaluate(TANK, GAIT, duration=0.05),
                           simulator.evaluate(TANK, GAIT, duration=1, overrides={"solver": {"relaxationMode": "global"}})]
        said = subprocess.run([simulator_path(), "stream", TANK, "--paused", "--fields=none"], capture_output=True,
                              input=b'{"id":1,"do":"sense","flow":[{"slice":2,"side":"left"}],"target":[1,1,1]}\n{"id":2,"do":"step","sense":true}\n').stdout
        cls.said = {}
        while said:
            letters, size = struct.unpack_from("<4sI", said)
            cls.said[letters], said = json.loads(said[8:8 + size]), said[8 + size:]

    def program(self, script, name="other"):
        path = Path(self.folder.name, name)
        path.write_text(f"#!/bin/sh\necho $$ > {shlex.quote(str(path))}.pid\n{script}\n")
        path.chmod(0o755)
        return str(path)

    def saying(self, *said, then="exec cat > /dev/null"):
        """A program that says this and reads on to the end."""
        path = Path(self.folder.name, "said")
        path.write_bytes(b"".join(said))
        return self.program(f"cat {shlex.quote(str(path))}\n{then}")

    def refused(self, use, message=None, kind=natator.ProgramError):
        """That use raises an error of one line, and that its program has ended."""
        with self.assertRaises(kind) as raised:
            use()
        self.assertNotIn("\n", str(raised.exception))
        self.assertLess(len(str(raised.exception)), 2000)
        if message:
            self.assertRegex(str(raised.exception), message)
        for file in Path(self.folder.name).glob("*.pid"):
            if number := file.read_text():  # empty: ended before it had said who it is
                with self.assertRaises(ProcessLookupError, msg="goes on"):
                    os.kill(int(number), 0)
            file.unlink()

    def used(self, use, name):
        """That what is changed is refused, or is of no use to anyone; whether it was refused."""
        try:
            use()
            return 0
        except natator.NatatorError as error:
            self.assertNotIn("\n", str(error))
            return 1
        except Exception as error:
            self.fail(f"{name}: {error!r}")

    def test_other_programs(self):
        scripts = {
            "exits at once": ("exit 0", "exit code 0"), "fails": ("exit 3", "exit code 3"),
            "is killed": ("kill -9 $$", "exit code -9"),
            "refuses by its own usage": ("echo 'usage: other [-x]' >&2; exit 2", "exit code 2: usage"),
            "says no word and lives": ("exec >&-; exec sleep 100", "reads or says no more, and goes on"),
            "says no word, lives and complains": ("exec >&-; while :; do echo bad >&2; done", "reads or says no more, and goes on"),
            "takes no word and lives": ("exec <&-; exec sleep 100", "reads or says no more, and goes on"),
            "leaves its output to another": ("sleep 3 & exit 4", "exit code 4"),
            "complains without end": ("while :; do echo $0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0$0; done >&2",
                                      "answers as no simulator does"),
            "complains without end of line": ("tr '\\0' x < /dev/zero >&2", "answers as no simulator does"),
            "says a line without end": ("tr '\\0' x < /dev/zero", "answers as no simulator does"),
            "says zeros without end": ("cat /dev/zero", "answers as no simulator does"),
            "says other words": ("while echo y; do :; done", "answers as no simulator does"),
            "is a web server": ("printf 'HTTP/1.1 400 Bad Request\\r\\n\\r\\n'; exec cat > /dev/null", "answers as no simulator does"),
            "half an answer": ("printf SCEN; exit 0", "exit code 0"),
            "is a terminal": ("printf '\\033[31m%05000d\\n' 7 >&2; exit 1", "exit code 1: .\\[31m0+…$"),
        }
        for name, (script, message) in scripts.items():
            program = self.program(script)
            with self.subTest(name):
                self.refused(lambda: natator.evaluate(TANK, GAIT, program=program), message)
                self.refused(lambda: natator.Simulator(2, program=program).evaluate_all([make_request(TANK, GAIT)] * 3), message)
                self.refused(lambda: natator.Stream(TANK, program=program), message)
                self.refused(lambda: natator.gym.SwimmerEnv(TANK, program=program), message)

    def test_a_version_is_asked_for_once_and_leaves_nobody_behind(self):
        child = Path(self.folder.name, "child")
        path = self.program(f"cat /dev/zero >&2 & echo $! > {shlex.quote(str(child))}; echo once >> {shlex.quote(str(child))}s; wait")
        for _ in range(2):
            self.assertEqual(simulator_path(path), path)
        self.assertEqual(Path(f"{child}s").read_text(), "once\n")
        until = time.monotonic() + 10
        with self.assertRaises(ProcessLookupError, msg="goes on"):
            while time.monotonic() < until:
                os.kill(int(child.read_text()), 0)
                time.sleep(0.01)

    def test_another_version(self):
        path = self.program("echo natator-sim 0.0.1, commit unknown")
        self.refused(lambda: natator.evaluate(TANK, GAIT, program=path),
                     r"is natator-sim 0\.0\.1, this package is [\d.]+: must be of the same version; ")

    def test_no_program(self):
        for program in (3, ["natator-sim"], {}, b"natator-sim"):
            self.refused(lambda: natator.Stream(TANK, program=program), "^program = .*: must be a path$", natator.InputError)
        for program in ("no\0program", "/", "/dev/null"):
            self.refused(lambda: natator.evaluate(TANK, program=program), "must be the program natator-sim")

    def test_lines_that_are_no_result(self):
        right = json.dumps(self.results[0])
        for text in ("3", "[]", "{}", "null", '"id"', "\xff", right[:-1], right.replace('"fitness":', '"fitness": NaN, "x":'),
                     right.replace('"fitness":', '"fitness": 1e999, "x":'), "[" * 100000, '{"id":' + "9" * 5000 + "}", right + right):
            with self.subTest(text[:30]):
                self.refused(lambda: natator.evaluate(TANK, GAIT, program=self.saying(text.encode("latin1") + b"\n")), "no simulator")

    def test_each_key_of_a_result(self):
        read = 0
        for result in (*self.results, {"id": 0, "status": "error", "error": "bad"}):
            for name, other in changed(result, depth=1):
                program = self.saying(json.dumps(other).encode() + b"\n")
                read += self.used(lambda: natator.evaluate(TANK, GAIT, program=program), name)
        self.assertGreater(read, 150)

    def test_an_answer_is_of_what_was_asked(self):
        def result(own):
            return json.dumps({**self.results[0], "id": own}).encode() + b"\n"

        requests = [make_request(TANK, GAIT)] * 2
        for ids in ([7], [-1], [True], [None], [0.0], [0, 0], [1, 1], [0, 2]):
            with self.subTest(ids), natator.Simulator(1, program=self.saying(*map(result, ids))) as simulator:
                self.refused(lambda: simulator.evaluate_all(requests), "no simulator")
        with natator.Simulator(1, program=self.saying(*map(result, (1, 0, 1)))) as simulator:  # one too many
            self.assertEqual([one["id"] for one in simulator.evaluate_all(requests)], [0, 1])
            self.refused(lambda: simulator.evaluate_all(requests), "no simulator")

    def test_the_first_words_of_a_stream(self):
        scene = self.said[b"SCEN"]
        for head in (b"SCEN\xff\xff\xff\xff", b"FRAM\0\0\0\0", b"STOP\0\0\0\x01", b"scen\4\0\0\0", b"SCEM\4\0\0\0{}  ", b"SCEN\2\0\0\0{}"):
            self.refused(lambda: natator.Stream(TANK, program=self.saying(head)), "no simulator")
        for body in (b"", b"3", b"[]", b"\xff", b"{", b"{}", b"[" * 10000, b'{"restarted": true}', b'{"restarted": 3}'):
            self.refused(lambda: natator.Stream(TANK, program=self.saying(message(b"SCEN", body))), "no simulator")
        other = message(b"SCEN", {**scene, "protocol": 3})
        self.refused(lambda: natator.Stream(TANK, program=self.saying(other)), "speaks protocol 3: must be 2")

    def test_each_key_of_a_scene(self):
        read = 0
        for name, scene in changed(self.said[b"SCEN"], depth=2):
            program = self.saying(message(b"SCEN", scene), message(b"ANSW", {**self.said[b"ANSW"], "id": 1}),
                                  message(b"ANSW", {"id": 2, "error": "no"}))
            read += self.used(lambda: natator.gym.SwimmerEnv(TANK, target=(1, 0.3, 0.3), flow=1, program=program).close(), name)
        self.assertGreater(read, 100)

    def test_each_key_of_an_answer(self):
        read = 0
        scene, answer = message(b"SCEN", self.said[b"SCEN"]), {**self.said[b"ANSW"], "id": 1}
        self.assertEqual(natator.Stream(TANK, program=self.saying(scene, message(b"ANSW", answer))).step().frame, 1)
        for name, other in changed(answer, depth=3):
            with natator.Stream(TANK, program=self.saying(scene, message(b"ANSW", other))) as stream:
                read += self.used(stream.step, name)
        self.assertGreater(read, 180)

    def test_other_messages_of_a_stream(self):
        scene, frame = message(b"SCEN", self.said[b"SCEN"]), b"\0" * 72
        for said in (message(b"ANSW", b"[]"), message(b"ANSW", {"id": 2, "ok": True}), message(b"ANSW", {"id": 2, "error": "no"}),
                     message(b"SCEN", {"restarted": False, "actuators": "x"}), message(b"SCEN", {"actuators": 2}),
                     message(b"FRAM", frame), message(b"FRAM", frame + b"\0" * 12), message(b"FRAM", b""),
                     message(b"STOP", {"reason": "unstable"}), message(b"STOP", b"[]"), message(b"XXXX", b"")):
            with self.subTest(said[:60]), natator.Stream(TANK, program=self.saying(scene, said)) as stream:
                self.refused(stream.step, "no simulator")
        for said in (b"", message(b"ANSW", {"id": 1, "ok": True})[:-4]):
            with natator.Stream(TANK, program=self.saying(scene, said, then="read line; exit 5")) as stream:
                self.refused(stream.step, "exit code 5")
        with natator.Stream(TANK, fields="position", program=self.saying(
                scene, message(b"ANSW", {"id": 1, "ok": True}), message(b"FRAM", frame + b"\0" * 8))) as stream:
            stream.begin_step()
            self.assertIsNotNone(stream.frame)
        first = natator.Stream(TANK)
        with first:
            with self.assertRaisesRegex(natator.ProgramError, "nothing was asked"):
                first.receive()


class ArgumentTest(unittest.TestCase):
    def test_no_text_is_taken_for_an_option(self):
        for use in (lambda text: natator.Stream(text), lambda text: natator.Stream(TANK, scheme=text),
                    lambda text: natator.Stream(TANK, fields=["position", text]),
                    lambda text: natator.evaluate(text, GAIT), lambda text: natator.evaluate(TANK, GAIT, scheme=text),
                    lambda text: natator.record(Path(text)), lambda text: natator.gym.SwimmerEnv(text)):
            for text in ("--help", "-h", "--", "-", "--version", "--gait={}", "--threads=2", "", "\0", "\ud800", "a\nb"):
                with self.subTest(text), self.assertRaises(natator.InputError) as raised:
                    use(text)
                self.assertNotIn("\n", str(raised.exception))

    def test_numbers_and_texts(self):
        for start in ("--help", "3", 1.5, True, -1, [3]):
            with self.assertRaisesRegex(natator.InputError, "^start = .*: must be a whole number from 0 on$"):
                natator.Stream(TANK, start=start)
        with self.assertRaisesRegex(natator.InputError, r"^fields\[1\] = 3: must be a text, not empty$"):
            natator.Stream(TANK, fields=["position", 3])
        with self.assertRaisesRegex(natator.InputError, "cannot be started: Argument list too long"):
            natator.Stream("x" * 3000000)

    def test_a_file_whose_name_begins_like_an_option(self):
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                Path("--tank.json").write_text(json.dumps({"base": TANK}))
                natator.Stream("--tank.json").close()
            finally:
                os.chdir(before)

    def test_what_the_program_cannot_tell_whose_it_is(self):
        deep = {}
        part = deep
        for _ in range(50):
            part["solver"] = part = {}
        with natator.Simulator(1) as simulator:
            for bad in ({"scene": "\ud800"}, make_request(TANK, GAIT, overrides=deep)):
                with self.assertRaisesRegex(natator.InputError, r"^requests\[1\]: request: "):
                    simulator.evaluate_all([make_request(TANK, GAIT, duration=0.05), bad])
            self.assertEqual(simulator.evaluate(TANK, GAIT, duration=0.05)["status"], "ok")


if __name__ == "__main__":
    unittest.main()
