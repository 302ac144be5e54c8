"""The verbs of ``up-sim``: each module has ``main(arguments) -> exit status``."""
