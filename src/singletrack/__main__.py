"""``python -m singletrack``: the command line."""

from singletrack.cli import main

if __name__ == "__main__":
    main()
