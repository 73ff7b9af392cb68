"""Named errors.  Catch `BihdistError` to catch all of them; each is also the built-in error it resembles."""

from .sentences import one_line


class BihdistError(Exception):
    """Anything this library refuses or fails to do; the message is one sentence a user can act on.

    Examples
    --------
    >>> import bihdist
    >>> try:
    ...     bihdist.read_surface("missing.off")
    ... except bihdist.BihdistError as error:
    ...     print(type(error).__name__, isinstance(error, FileNotFoundError))
    MissingFileError True
    """

    def __str__(self) -> str:
        return one_line(super().__str__())


class MeshError(BihdistError, ValueError):
    """A mesh file or array that cannot be a surface."""


class MissingFileError(MeshError, FileNotFoundError):
    """A mesh file that is not there."""


class VertexError(BihdistError, ValueError):
    """A vertex id that does not exist or belongs to no face."""


class ParameterError(BihdistError, ValueError):
    """A parameter outside its meaning: a negative time, an unknown method."""


class MissingInputError(ParameterError, FileNotFoundError):
    """A file of pins, maps, curves or numbers, or a recipe, that is not there."""


class SolverError(BihdistError, RuntimeError):
    """A numerical result that cannot be trusted."""


class NotEnoughMemory(MemoryError, BihdistError):  # in this order, or it is not made again from a pickle
    """Work that needs more memory than there is, found out before it begins."""


class OutputError(BihdistError, OSError):
    """A file that could not be written."""


class Cancelled(BihdistError):
    """Raised from a progress callback to stop long work; raised again to whoever asked for it.

    No failure: whoever catches BihdistError to report failures and stops work by it catches this one first.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> def stop(fraction, text):
    ...     raise bihdist.Cancelled
    >>> try:
    ...     bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3), progress=stop)
    ... except bihdist.Cancelled:
    ...     print("stopped")
    stopped
    """


class PlainSolverWarning(RuntimeWarning):
    """The compiled kernel cannot be used; the message says why, and what to do."""


class LandmarkWarning(UserWarning):
    """What is to be known of the positions in a file of landmarks, such as those far from the surface."""


def unreadable(what: str, error: Exception) -> ParameterError:
    """Return the error for a file that was not read, such as "The pins in a.csv", with the reason."""
    reason = getattr(error, "strerror", None) or error
    if isinstance(error, UnicodeDecodeError):
        reason = "it is not a text file"
    kind = MissingInputError if isinstance(error, FileNotFoundError) else ParameterError
    return kind(f"{what} cannot be read: {reason}.")
