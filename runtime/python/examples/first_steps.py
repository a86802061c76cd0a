import branched_pendulum as bp
import numpy as np

# Two equal links hang from one; `c` is the friction in their pivots, N m s.
tree = bp.Tree("""
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = c) * 2
    ]""", c=0.0)
frequencies, shapes = tree.modes()
print("modes:", np.round(frequencies, 4), "Hz")

# Released from rest at 47.8°, the children a hundredth of a radian to both sides.
y0 = np.array([np.radians(47.8), 0.01, -0.01, 0.0, 0.0, 0.0])
t = np.linspace(0.0, 6.0, 601)
motion = tree.integrate(y0, t, rtol=1e-12)
difference = np.abs(motion.y[:, 1] - motion.y[:, 2]) / 2
print(motion.report)
print(f"largest difference: {difference.max():.2f} rad")
assert np.ptp(tree.energy(motion.y)) < 1e-9

# With friction, from 181 angles at once: the largest difference after each release.
damped = tree.changed(c=3.5e-5)
angles = np.linspace(40.0, 49.0, 181)
starts = np.tile(y0, (len(angles), 1))
starts[:, 0] = np.radians(angles)
motions = damped.ensemble(starts, t, rtol=1e-9)    # start, time, component
largest = np.abs(motions[:, :, 1] - motions[:, :, 2]).max(axis=1) / 2
print(f"tenfold from {angles[largest > 0.1][0]:.2f}° on")
