"""What the quantities that are no difference have in common: each is the one part of itself."""

from typing import TypeVar

from bihdist_core.distances.kinds import Spec

Self = TypeVar("Self", bound="Alone")
Other = TypeVar("Other")


class Alone:
    """A quantity of one part; if nothing else is said, of no distance, and it starts nowhere."""

    @property
    def parts(self: Self) -> tuple[Self, ...]:
        return (self,)

    def with_parts(self, parts: tuple[Other, ...]) -> Other:
        """Another part instead."""
        (part,) = parts
        return part

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the points that it starts from."""
        return ()

    @property
    def specs(self) -> tuple[Spec, ...]:
        """The distances it is made of."""
        return ()


class ByDistance(Alone):
    """Made by one distance."""

    spec: Spec

    @property
    def before(self) -> str:
        """What its words begin with, before those of the distance."""
        return ""

    def __str__(self) -> str:
        return f"{self.before}{self.spec}"

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (self.spec,)

    @property
    def word(self) -> str:
        """Which distance it is, whatever its parameters."""
        return f"{self.before}{self.spec.word}"

    @property
    def title(self) -> str:
        """Its name within a sentence."""
        return f"{self.before}{self.spec.kind.name.lower()}"
