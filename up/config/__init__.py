"""Configuration: YAML files with comments, defaults, bounds and errors with line and column.

A file is declared as a frozen dataclass whose fields are `key`, `section`, `mapping` or `items`,
and named by a `ConfigFile`.
"""

from up.config.file import ConfigFile, load_all, unknown_files
from up.config.learned import LearnedFile
from up.config.problems import ConfigErrors, ConfigProblem
from up.config.shape import items, key, mapping, section
from up.config.writing import write_schemas, write_template

__all__ = [
    "ConfigErrors",
    "ConfigFile",
    "ConfigProblem",
    "LearnedFile",
    "items",
    "key",
    "load_all",
    "mapping",
    "section",
    "unknown_files",
    "write_schemas",
    "write_template",
]
