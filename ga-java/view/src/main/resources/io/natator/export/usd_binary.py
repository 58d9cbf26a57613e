"""Writes a layer of USD in its binary form: usd_binary.py FROM.usda TO.usdc"""

import sys

from pxr import Sdf

source, target = sys.argv[1:]
layer = Sdf.Layer.OpenAsAnonymous(source)
if not layer or not layer.Export(target):
    sys.exit(f"{source} cannot be written as {target}")
