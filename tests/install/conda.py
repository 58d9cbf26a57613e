"""What conda.sh does inside its systems, by py-rattler-build and py-rattler.

    conda.py channel PARTS FOLDER                    a channel of packages, each from a folder NAME=VERSION in PARTS
    conda.py build RECIPE VARIANTS CHANNEL OUT       the recipe's package, tested as the recipe says
    conda.py install NAME PREFIX CHANNEL...          as a user does it
"""

import asyncio
import sys
from pathlib import Path

SUBDIR = "linux-64"


def url(channel):
    """Of a folder, or a name such as conda-forge."""
    return Path(channel).as_uri() if "/" in channel else channel


def index(folder):
    from rattler.index import index_fs

    asyncio.run(index_fs(folder, force=True))


def channel(parts, folder):
    from rattler_build import assemble_package

    for part in sorted(Path(parts).iterdir()):
        name, version = part.name.split("=")
        assemble_package(name, version, SUBDIR, "0", Path(folder, SUBDIR), files_dir=part, compression_level=1)
    index(folder)


def build(recipe, variants, needed, folder):
    from rattler_build import Package, Stage0Recipe, ToolConfiguration, VariantConfig

    for variant in Stage0Recipe.from_file(recipe).render(VariantConfig.from_file(variants)):
        for file in variant.run_build(ToolConfiguration(error_prefix_in_binary=True), folder, [url(needed)], no_build_id=True).packages:
            tests = Package.from_file(file).run_tests(channel=[url(folder), url(needed)])
            print(f"{Path(file).name}: {Path(file).stat().st_size} bytes, {len(tests)} test")
            if not tests or not all(test.success for test in tests):
                sys.exit("\n".join(line for test in tests for line in test.output))
    index(folder)


def install(name, prefix, *channels):
    import rattler

    async def both():
        records = await rattler.solve([url(channel) for channel in channels], [name], platforms=[SUBDIR, "noarch"],
                                      virtual_packages=rattler.VirtualPackage.detect())
        await rattler.install(records, prefix, show_progress=False)
        print("installed:", *(f"{record.name.normalized} {record.version}" for record in records))

    asyncio.run(both())


if __name__ == "__main__":
    {"channel": channel, "build": build, "install": install}[sys.argv[1]](*sys.argv[2:])
