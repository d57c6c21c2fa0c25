"""Three actions tried from one moment of a lift."""

import colift

env = colift.make(behaviour="pause", subject="S3").unwrapped
env.reset(seed=7)
for _ in range(20):
    env.step(0.005)
moment, found = env.save(), {}
for action in (-0.02, 0.0, 0.02):
    env.restore(moment)
    found[action] = sum(env.step(action)[1] for _ in range(3))
print(f"{max(found, key=found.get):+.2f} m is best")
env.close()
