"""What does a main shock leave for an aftershock? A tied wall with and without it.

    python examples/python/sequence.py
"""

import rocking_wall as rw

wall = rw.Wall(
    height=3, thickness=0.3, tie_height=2.6, tie_stiffness=2e6, tie_strength=3e3, tie_ultimate=0.2
)
main = rw.synthetic_record(1, duration=15, pga=3.0)
after = rw.synthetic_record(2, duration=15, pga=2.5)

# %% One after the other: the wall and its tie go on from one shock to the next.
response = wall.simulate(rw.sequence([main, after], pause=10))
alone = wall.simulate(after)
for number, shock in enumerate(response.shocks, 1):
    fate = "falls" if shock["falls"] else "stands"
    stretched = 1000 * shock["demands"]["tie_elongation"]
    print(f"shock {number}: |u| {shock['u_ratio_max']:.3f} u_ins, tie stretched {stretched:.1f} mm, {fate}")
print(f"the aftershock by itself: |u| {alone.u_ratio_max:.3f} u_ins")

# %% Main shocks of other sizes before the same aftershock.
for factor in (0.0, 0.5, 1.0, 1.5):
    shocks = wall.simulate(rw.sequence([factor * main, after])).shocks
    print(f"main shock x {factor}: aftershock |u| {shocks[-1]['u_ratio_max']:.3f} u_ins")
