"""Every program of docs/other-languages.md works as printed, and so do the examples that it names.
Only the port is another. Java is not needed for the tests, so its program is not run."""
import pathlib
import re
import shutil
import sys
import unittest

from running import SOURCE, Serving

PAGE = (SOURCE / "docs/other-languages.md").read_text()
EXPECTED = {
    "one_frame": r"converged: explained .*\n +GGP ",
    "stream": r"(\d\.\d+ s: converged, .*\n){5}",
    "cancel": "cancelled: ",
}


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


def command(start):
    """The one command of the page that begins so."""
    [line] = re.findall(rf"^{re.escape(start)}.*$", PAGE, re.MULTILINE)
    return line


class Page(Serving):
    shared = True

    def output(self, *words):
        return self.output_of(*words, LCM_DEFAULT_URL=self.server.url)

    def printed(self, program):
        return self.output(sys.executable, "-c", program.replace("7700", str(self.server.port)))

    def test_the_python_programs_work_as_printed(self):
        client, tcpq = blocks("python")
        output = self.printed(client)
        self.assertRegex(output, r"converged explained RMS 0\.\d\d mm\n")
        self.assertRegex(output, r"GGP +\d\.\d\d N, 90 %: \d\.\d\d to \d\.\d\d N, acts with prob")
        self.assertRegex(self.printed(tcpq), r"GENIO_STATUS \d+ bytes\n")

    def test_the_examples_work_as_printed(self):
        commands = re.findall(r"^python3 (python/examples/(\w+)\.py) (\S+)$", PAGE, re.MULTILINE)
        self.assertEqual({name for _, name, _ in commands},
                         {path.stem for path in (SOURCE / "python/examples").glob("*.py")})
        for program, name, file in commands:
            output = self.output(sys.executable, SOURCE / program, SOURCE / file)
            self.assertRegex(output, EXPECTED[name])

    def test_the_types_are_made_as_printed(self):
        package = self.folder / "python/genio_client"
        shutil.copytree(SOURCE / "python/genio_client", package,
                        ignore=lambda *_: {"lcm_types", "__pycache__"})
        (self.folder / "messages").symlink_to(SOURCE / "messages")
        self.output("sh", "-c", f"cd '{self.folder}' && {command('lcm-gen -p')}")
        found = self.output_of(sys.executable, "-c", "import genio_client as g; print(g.__file__)",
                               PYTHONPATH=str(self.folder / "python"))
        self.assertEqual(pathlib.Path(found.strip()).parent.resolve(), package.resolve())

    def test_the_c_program_works_as_printed(self):
        [program] = blocks("c")
        (self.folder / "ask.c").write_text(program)
        (self.folder / "messages").symlink_to(SOURCE / "messages")
        (self.folder / "c").mkdir()
        compiling = f"{command('lcm-gen -c')} && {command('cc ')}"
        self.output("sh", "-c", f"cd '{self.folder}' && {compiling}")
        self.assertRegex(self.output(self.folder / "ask"), r"converged .*\nGGP +\d\.\d\d N\n")


if __name__ == "__main__":
    unittest.main()
