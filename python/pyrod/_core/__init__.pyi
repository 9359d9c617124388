"""
The compiled part of pyrod. Use it through the package.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
from . import rotation
from . import section
from . import curve
__all__: list[str] = ['Branch', 'Clamp', 'DistributedForce', 'DistributedMoment', 'Equilibrium', 'Force', 'Gravity', 'Hinge', 'Joint', 'Linearised', 'Moment', 'Options', 'Pivot', 'PointMass', 'Rod', 'RodSolution', 'Scene', 'SingularEquilibrium', 'Sleeve', 'Slider', 'Solver', 'Spring', 'Tendon', 'breaks', 'build', 'curve', 'follow', 'limit', 'natural_edges', 'rotation', 'section', 'solve_all']
class Rod:
    """
    A rod as it was given, and on its grid.
    """
    @staticmethod
    def of_arrays(edge_lengths: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], bending: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], stretching: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], K0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], mass: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], corners: bool, jumps: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], sides: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], model: str, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Rod:
        ...
    @staticmethod
    def of_sections(edge_lengths: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], section: typing.Any, curvature: typing.Any, corners: bool, model: str | None, chooses: bool, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Rod:
        ...
    def at_rest(self, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        ...
    def energy(self, positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], start_frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, end_frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None) -> tuple:
        ...
    def on(self, edge_lengths: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], kept: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] | None, marks: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> Rod:
        ...
    def replaced(self, model: str, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Rod:
        ...
    def with_vertices(self, at: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Rod | None:
        """
        None: they are there.
        """
    @property
    def K0(self) -> numpy.ndarray:
        ...
    @property
    def arc_lengths(self) -> numpy.ndarray:
        ...
    @property
    def bending(self) -> numpy.ndarray:
        ...
    @property
    def edge_lengths(self) -> numpy.ndarray:
        ...
    @property
    def edges(self) -> int:
        ...
    @property
    def jumps(self) -> tuple:
        ...
    @property
    def kept(self) -> list[float] | None:
        ...
    @property
    def length(self) -> float:
        ...
    @property
    def marks(self) -> list[float]:
        ...
    @property
    def mass_per_length(self) -> numpy.ndarray:
        ...
    @property
    def model(self) -> str:
        ...
    @property
    def stretching(self) -> numpy.ndarray:
        ...
class Options:
    """
    What may be tuned in a solve; keywords only.
    """
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *args, **kwargs) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def max_edges(self) -> int:
        """
        edges of all rods together on the finest grid that a tolerance may lead to
        """
    @property
    def max_iterations(self) -> int:
        """
        linear solves of one run before giving up
        """
    @property
    def max_time(self) -> float:
        """
        seconds that the grids of a tolerance may take; none is begun that would end later, if it took as long as the one before
        """
    @property
    def near(self) -> float:
        """
        steps [rad] below which the exact Hessian replaces the convex one
        """
    @property
    def tolerance(self) -> float:
        """
        largest component [rad] of the last full Newton step; the error left is of the order of its square
        """
    @property
    def trust(self) -> float:
        """
        longest step [rad] taken on the word of the exact Hessian
        """
class Clamp:
    fields: typing.ClassVar[list] = ['position', 'frame', 'at', 'turns']
    def __init__(self, *args) -> None:
        ...
class Hinge:
    fields: typing.ClassVar[list] = ['position', 'at']
    def __init__(self, *args) -> None:
        ...
class Slider:
    fields: typing.ClassVar[list] = ['along', 'normal', 'position', 'frame', 'clamped', 'at']
    def __init__(self, *args) -> None:
        ...
class Sleeve:
    fields: typing.ClassVar[list] = ['position', 'frame', 'at']
    def __init__(self, *args) -> None:
        ...
class Pivot:
    fields: typing.ClassVar[list] = ['axis', 'position', 'frame', 'at', 'along']
    def __init__(self, *args) -> None:
        ...
class Spring:
    fields: typing.ClassVar[list] = ['stiffness', 'torsion', 'position', 'frame', 'at']
    def __init__(self, *args) -> None:
        ...
class Force:
    fields: typing.ClassVar[list] = ['force', 'at', 'follower']
    def __init__(self, *args) -> None:
        ...
class Moment:
    fields: typing.ClassVar[list] = ['moment', 'at', 'follower']
    def __init__(self, *args) -> None:
        ...
class DistributedForce:
    fields: typing.ClassVar[list] = ['force_per_length', 'rod', 'follower']
    def __init__(self, *args) -> None:
        ...
class DistributedMoment:
    fields: typing.ClassVar[list] = ['moment_per_length', 'rod', 'follower']
    def __init__(self, *args) -> None:
        ...
class Gravity:
    fields: typing.ClassVar[list] = ['acceleration']
    def __init__(self, *args) -> None:
        ...
class PointMass:
    fields: typing.ClassVar[list] = ['mass', 'at']
    def __init__(self, *args) -> None:
        ...
class Tendon:
    fields: typing.ClassVar[list] = ['offset', 'tension', 'length', 'EA', 'start', 'end', 'rod']
    def __init__(self, *args) -> None:
        ...
class Joint:
    fields: typing.ClassVar[list] = ['points', 'kind', 'turns', 'aligned', 'axis']
    def __init__(self, *args) -> None:
        ...
class RodSolution:
    """
    One rod in equilibrium.
    """
    @property
    def Gamma(self) -> numpy.ndarray:
        ...
    @property
    def K(self) -> numpy.ndarray:
        ...
    @property
    def K_before(self) -> numpy.ndarray:
        ...
    @property
    def backbone_force(self) -> numpy.ndarray:
        ...
    @property
    def bend_twist_energy(self) -> float:
        ...
    @property
    def force(self) -> numpy.ndarray:
        ...
    @property
    def frames(self) -> numpy.ndarray:
        ...
    @property
    def largest_K(self) -> float:
        ...
    @property
    def largest_force(self) -> float:
        ...
    @property
    def largest_moment(self) -> float:
        ...
    @property
    def load(self) -> numpy.ndarray:
        ...
    @property
    def load_moment(self) -> numpy.ndarray:
        ...
    @property
    def material_force(self) -> numpy.ndarray:
        ...
    @property
    def material_moment(self) -> numpy.ndarray:
        ...
    @property
    def moment(self) -> numpy.ndarray:
        ...
    @property
    def moment_before(self) -> numpy.ndarray:
        ...
    @property
    def positions(self) -> numpy.ndarray:
        ...
    @property
    def stretch_shear_energy(self) -> float:
        ...
    @property
    def vertex_force(self) -> numpy.ndarray:
        ...
    @property
    def vertex_force_before(self) -> numpy.ndarray:
        ...
    @property
    def vertex_frames(self) -> numpy.ndarray:
        ...
class Equilibrium:
    """
    A scene, solved.
    """
    def rod(self, number: typing.SupportsInt | typing.SupportsIndex) -> RodSolution:
        ...
    @property
    def accuracy(self) -> typing.Any:
        ...
    @property
    def advice(self) -> str:
        ...
    @property
    def descents(self) -> int:
        ...
    @property
    def doubts(self) -> list:
        ...
    @property
    def fill(self) -> float:
        ...
    @property
    def index(self) -> int:
        ...
    @property
    def load_steps(self) -> int:
        ...
    @property
    def lowest_eigenvalue(self) -> float:
        ...
    @property
    def mode(self) -> typing.Any:
        ...
    @property
    def multipliers(self) -> int:
        ...
    @property
    def neutral(self) -> bool:
        ...
    @property
    def reactions(self) -> tuple:
        ...
    @property
    def record(self) -> dict:
        ...
    @property
    def residual(self) -> float:
        ...
    @property
    def status(self) -> str:
        ...
    @property
    def tendons(self) -> tuple:
        ...
    @property
    def unknowns(self) -> int:
        ...
class Scene:
    """
    A scene that is ready to be solved.
    """
    def __init__(self, rods: collections.abc.Sequence[Rod], supports: collections.abc.Sequence[Clamp | Hinge | Slider | Sleeve | Pivot | Spring], joints: collections.abc.Sequence[Joint], loads: collections.abc.Sequence[Force | Moment | DistributedForce | DistributedMoment | Gravity | PointMass], actuators: collections.abc.Sequence[Tendon], space: str) -> None:
        ...
    def climbing_rods(self, given: collections.abc.Sequence[Rod]) -> list:
        """
        The same of a solve with a tolerance.
        """
    def dead_loads(self, rod: typing.SupportsInt | typing.SupportsIndex) -> tuple:
        ...
    def free_directions(self, support: typing.SupportsInt | typing.SupportsIndex, frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.ndarray:
        ...
    def held(self, support: typing.SupportsInt | typing.SupportsIndex) -> tuple:
        ...
    def leaving_plane(self, across: typing.SupportsInt | typing.SupportsIndex) -> str:
        """
        What leaves the plane across a1 (0) or a2 (1), in words.
        """
    def level(self, number: typing.SupportsInt | typing.SupportsIndex) -> tuple:
        ...
    def on_climbing_edges(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.ndarray:
        ...
    def rods(self, given: collections.abc.Sequence[Rod]) -> list:
        """
        As they are solved; None for those that are as given.
        """
    def solve(self, start: typing.Any, options: Options, tol: typing.SupportsFloat | typing.SupportsIndex | None, stable: bool, eigenvalue: bool, trace: collections.abc.Callable | None, progress: collections.abc.Callable | None) -> Equilibrium:
        ...
    def vertex(self, at: typing.Any) -> tuple:
        ...
    @property
    def plane(self) -> tuple:
        ...
    @property
    def rods_are_asked(self) -> bool:
        ...
class Solver:
    """
    A scene that is solved again and again.
    """
    def __init__(self, scene: Scene) -> None:
        ...
    def forget(self) -> None:
        ...
    def solve(self, scene: Scene, rods: collections.abc.Sequence[tuple[typing.SupportsInt | typing.SupportsIndex, Rod]], supports: collections.abc.Sequence[tuple[typing.SupportsInt | typing.SupportsIndex, Clamp | Hinge | Slider | Sleeve | Pivot | Spring]], joints: collections.abc.Sequence[tuple[typing.SupportsInt | typing.SupportsIndex, Joint]], loads: collections.abc.Sequence[tuple[typing.SupportsInt | typing.SupportsIndex, Force | Moment | DistributedForce | DistributedMoment | Gravity | PointMass]], actuators: collections.abc.Sequence[tuple[typing.SupportsInt | typing.SupportsIndex, Tendon]], options: Options, stable: bool, eigenvalue: bool, tol: typing.SupportsFloat | typing.SupportsIndex | None) -> Equilibrium:
        ...
    def solve_numbers(self, numbers: list, options: Options, stable: bool, eigenvalue: bool, tol: typing.SupportsFloat | typing.SupportsIndex | None) -> Equilibrium:
        ...
class SingularEquilibrium(ArithmeticError):
    pass
class Linearised:
    """
    How an equilibrium answers to small changes.
    """
    def __init__(self, scene: Scene, near: Equilibrium) -> None:
        ...
    def compliance(self, rod: typing.SupportsInt | typing.SupportsIndex, vertex: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def follow(self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict:
        ...
    def free(self) -> list:
        ...
    def numbers(self, scene: Scene) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def of_forces(self, forces: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64]]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def of_moment(self, rod: typing.SupportsInt | typing.SupportsIndex, vertex: typing.SupportsInt | typing.SupportsIndex, moment: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def of_moments(self, moments: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64]]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def of_motion(self, support: typing.SupportsInt | typing.SupportsIndex, shift: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], turn: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def of_rod(self, rod: typing.SupportsInt | typing.SupportsIndex, bending: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], stretching: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], K0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def pull(self, arg0: dict) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        ...
    def push(self, numbers: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict:
        ...
    def pushes_freely(self) -> list:
        ...
    def solved(self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def to_rod(self, arg0: typing.SupportsInt | typing.SupportsIndex, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> tuple:
        ...
    @property
    def symmetric(self) -> bool:
        ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
class Branch:
    """
    Equilibria one behind the other.
    """
    def derivative(self, number: typing.SupportsInt | typing.SupportsIndex, family: typing.Any, apart: typing.SupportsFloat | typing.SupportsIndex) -> float:
        ...
    def equilibrium(self, point: typing.SupportsInt | typing.SupportsIndex, eigenvalue: bool) -> Equilibrium:
        ...
    def special_equilibrium(self, number: typing.SupportsInt | typing.SupportsIndex) -> Equilibrium:
        ...
    def switched(self, number: typing.SupportsInt | typing.SupportsIndex, side: typing.SupportsInt | typing.SupportsIndex, start: typing.SupportsFloat | typing.SupportsIndex, stop: typing.SupportsFloat | typing.SupportsIndex, max_points: typing.SupportsInt | typing.SupportsIndex, look: collections.abc.Callable | None) -> Branch:
        ...
    @property
    def ended(self) -> str:
        ...
    @property
    def indices(self) -> numpy.ndarray:
        ...
    @property
    def reason(self) -> str:
        ...
    @property
    def special(self) -> list:
        ...
    @property
    def values(self) -> numpy.ndarray:
        ...
def breaks(function: collections.abc.Callable, length: typing.SupportsFloat | typing.SupportsIndex) -> tuple[tuple, bool]:
    """
    Where a function of arc length jumps or has kinks, and whether there is more of that.
    """
def build() -> dict:
    """
    Versions of CHOLMOD and Eigen, the compiler, and the instructions that are used.
    """
def follow(family: typing.Any, start: typing.SupportsFloat | typing.SupportsIndex, stop: typing.SupportsFloat | typing.SupportsIndex, max_points: typing.SupportsInt | typing.SupportsIndex, equilibrium: Equilibrium, options: Options, look: collections.abc.Callable | None) -> Branch:
    ...
def limit(grids: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], even: bool, noise: typing.SupportsFloat | typing.SupportsIndex) -> tuple:
    ...
def natural_edges(length: typing.SupportsFloat | typing.SupportsIndex, curvature: typing.Any) -> float:
    ...
def solve_all(scenes: collections.abc.Sequence[Scene], starts: list, options: Options, tol: typing.SupportsFloat | typing.SupportsIndex | None, stable: bool, eigenvalue: bool, threads: typing.SupportsInt | typing.SupportsIndex, progress: collections.abc.Callable | None) -> list[Equilibrium]:
    ...
