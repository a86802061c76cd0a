"""Trees under names, as texts: `Tree(examples.PAPER, friction=0)`.

They are those of the command `branched-pendulum`; each begins with a comment that says what it is,
and names in it are parameters.
"""

from ._native import example_texts as _example_texts

_texts = dict(_example_texts())

#: The branched double pendulum of the paper; parameter `friction` (N m s).
PAPER: str = _texts["PAPER"]
#: The paper's apparatus with all its properties as parameters.
APPARATUS: str = _texts["APPARATUS"]
#: A measured double pendulum with all its properties as parameters.
DOUBLE_PENDULUM: str = _texts["DOUBLE_PENDULUM"]
#: Two rods; parameters `upper_length`, `lower_length` (m), `friction`.
CHAIN: str = _texts["CHAIN"]
#: Three rods; parameter `friction`.
TRIPLE: str = _texts["TRIPLE"]
#: A branch that stands on springs.
Y: str = _texts["Y"]
#: Five generations of rods; parameters `gravity` (m/s²), `mass_ratio`, `length_ratio`, `friction`
#: (of the youngest pivots, N m s), `friction_ratio` (of one generation over the one above) and
#: `sibling_friction` (between the youngest rods on one, N m s).
CASCADE: str = _texts["CASCADE"]
#: A branch of 31 rods that stands, held up by springs.
BRANCH: str = _texts["BRANCH"]

__all__ = ["APPARATUS", "BRANCH", "CASCADE", "CHAIN", "DOUBLE_PENDULUM", "PAPER", "TRIPLE", "Y"]
