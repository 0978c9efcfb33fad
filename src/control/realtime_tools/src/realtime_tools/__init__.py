"""Publishing from a control loop without blocking it."""
from .publisher import RateGate, RealtimePublisher

__all__ = ["RateGate", "RealtimePublisher"]
