"""M01 to M20."""

from hurcules.reproduce.claim import Claim

__all__ = ["MANIPULATION"]

MANIPULATION = tuple(Claim(f"M{i:02}", "", "") for i in range(1, 21))
