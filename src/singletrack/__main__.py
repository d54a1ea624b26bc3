"""``python -m singletrack``: the command line."""

from singletrack.commands.app import main

if __name__ == "__main__":
    main()
