"""The paper's claims in words, each measured."""

from ..evidence import Evidence
from ..table_one import TableOne
from .claim import Claim
from .confidence import confidence_claims
from .forgetting import forgetting_claims
from .learning import learning_claims
from .performance import performance_claims
from .prediction import prediction_claims
from .table import table_claims
from .timing import timing_claims

__all__ = ["Claim", "all_claims"]


def all_claims(evidence: Evidence, table: TableOne) -> list[Claim]:
    """Return every claim of the paper, measured, in the order of the paper's section IV."""
    return [
        *learning_claims(evidence.learning),
        *prediction_claims(evidence.lifts),
        *confidence_claims(evidence.lifts, evidence.pauses),
        *forgetting_claims(evidence.rests, evidence.pauses, evidence.forgetting),
        *table_claims(table),
        *performance_claims(evidence),
        *timing_claims(evidence.timing),
    ]
