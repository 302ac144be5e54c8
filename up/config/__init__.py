"""Configuration: YAML files with comments, defaults, bounds and errors with line and column.

A file is declared as a frozen dataclass whose fields are `key`, `section`, `mapping` or `items`,
and named by a `ConfigFile`.
"""

from up.config.atomic_writer import write_schemas, write_template
from up.config.file import ConfigFile, load_all, no_configuration, unknown_files
from up.config.persisted import PersistedFile
from up.config.problems import ConfigErrors, ConfigProblem
from up.config.schema import items, key, mapping, section

__all__ = [
    "ConfigErrors",
    "ConfigFile",
    "ConfigProblem",
    "PersistedFile",
    "items",
    "key",
    "load_all",
    "mapping",
    "no_configuration",
    "section",
    "unknown_files",
    "write_schemas",
    "write_template",
]
