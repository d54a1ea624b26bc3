"""Writing files: whole or not at all, and nothing destroyed that is not a file."""

from singletrack.output.files import check_writable, prepare_folder, write_whole

__all__ = ["check_writable", "prepare_folder", "write_whole"]
