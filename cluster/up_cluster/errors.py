"""What NATS and S3 answer when they do not do what was requested."""


class UnavailableError(Exception):
    """A request got no answer: `code` is `no_connection`, `timeout` or `no_responders`.

    After `timeout` and `no_connection` it is unknown whether the request was carried out.
    """

    def __init__(self, code: str, service: str = "NATS") -> None:
        super().__init__(f"no answer from {service} ({code})")
        self.code = code


class RefusedError(Exception):
    """A service refused a request; `code` is JetStream's err_code, or the code of S3."""

    def __init__(self, code: int | str, reason: str, service: str = "JetStream") -> None:
        super().__init__(f"{service} refused: {reason} ({code})")
        self.code = code


class WrongRevisionError(RefusedError):
    """What a write would replace has another revision than the write expected."""
