"""python -m natator report RUN"""

from natator.report import main

main()
