"""Publishing from a control loop without blocking it."""

from node_signals.rates import RateGate

from .prompt import make_prompt
from .publisher import RealtimePublisher

__all__ = ["RateGate", "RealtimePublisher", "make_prompt"]
