"""A simulated camera before the paper's apparatus: data whose truth is known."""

import numpy as np

LINKS = ["parent", "left", "right"]


def film(model, degrees=47.8, difference=0.01, duration=4.0, rate=240.0):
    """A release from rest with vertical children, at every picture."""
    t = np.arange(round(duration * rate) + 1) / rate
    start = [np.radians(degrees), difference, -difference, 0, 0, 0]
    return model.integrate(start, t, rtol=1e-13)


def dots(theta, noise=2e-4, seed=1, apart=0.25, joint=0.27):
    """Places x, y (m, y downwards) of two dots a link, by link and end, with noise (m)."""
    direction = np.stack([np.sin(theta), np.cos(theta)], axis=-1)
    pivots = np.stack([0 * direction[:, 0], joint * direction[:, 0], joint * direction[:, 0]], 1)
    places = np.stack([pivots, pivots + apart * direction], axis=2)
    return places + np.random.default_rng(seed).normal(0, noise, places.shape)


def deep_lab_cut(path, places, likelihood=None):
    """Writes the dots as DeepLabCut does: rows of scorer, body parts and coordinates."""
    frames = len(places)
    parts = [f"{link}-{end}" for link in LINKS for end in ["top", "end"]]
    if likelihood is None:
        likelihood = np.full((frames, 6, 1), 0.99)
    columns = np.concatenate([places.reshape(frames, 6, 2), likelihood], axis=2)
    with open(path, "w") as file:
        file.write("scorer" + 18 * ",camera" + "\n")
        file.write("bodyparts," + ",".join(part for part in parts for _ in range(3)) + "\n")
        file.write("coords" + 6 * ",x,y,likelihood" + "\n")
        for frame, row in enumerate(columns.reshape(frames, 18)):
            file.write(f"{frame}," + ",".join(f"{value:.6f}" for value in row) + "\n")


def angles(places):
    """Angles of the links (rad) as they follow from the dots."""
    x, y = np.moveaxis(places[:, :, 1] - places[:, :, 0], -1, 0)
    return np.unwrap(np.arctan2(x, y), axis=0)
