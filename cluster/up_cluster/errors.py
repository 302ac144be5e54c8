"""What NATS and S3 answer when they do not do what was requested."""


class UnavailableError(Exception):
    """A request got no answer, or none that counts; whether it was carried out is unknown.

    `code` is `no_connection`, `timeout`, `no_responders` (not carried out), `contended` or
    `malformed`; of S3 the class of the error in boto3.
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
