"""Publishing from a control loop without blocking it."""
from .prompt import make_prompt
from .publisher import RateGate, RealtimePublisher

__all__ = ["RateGate", "RealtimePublisher", "make_prompt"]
