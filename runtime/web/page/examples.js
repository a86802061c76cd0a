// Trees to begin with: descriptions in the grammar of the attribute, with values of their
// parameters (SI units) and a release (degrees). Addresses have their `id`.

const release = (root, others, apart) => ({ root, others, apart });

export const examples = [
  {
    id: "paper",
    title: "the paper's pendulum",
    values: { g: 9.80665, l: 0.27, m: 0.10531, c: 0 },
    release: release(47.8, 0, 0.6),
    text: `gravity = g,
// Toda and Ooshida's apparatus. The joint of the children
// carries nothing: it says how long they are drawn.
parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3,
       joint = l, friction = c) [
    child(mass = m, com = 0.043, inertia = 0.516e-3,
          joint = 0.12, friction = c) * 2
]`,
  },
  {
    id: "three-generations",
    title: "three generations",
    values: { g: 9.81, m: 0.1, l: 0.3, r: 0.7, c: 0 },
    release: release(70, 20, 1),
    text: `gravity = g,
trunk: rod(mass = m, length = l, friction = c) [
    limb: rod(mass = r * m, length = r * l, friction = c) [
        twig: rod(mass = r^2 * m, length = r^2 * l, friction = c) * 2
    ] * 2
]`,
  },
  {
    id: "five-generations",
    title: "five generations: 31 links",
    values: { g: 9.81, m: 0.1, l: 0.25, r: 0.75, c: 0.00001 },
    release: release(60, 20, 2),
    text: `gravity = g,
trunk: rod(mass = m, length = l, friction = c) [
    limb: rod(mass = r * m, length = r * l, friction = c) [
        bough: rod(mass = r^2 * m, length = r^2 * l, friction = c) [
            twig: rod(mass = r^3 * m, length = r^3 * l, friction = c) [
                leaf: rod(mass = r^4 * m, length = r^4 * l, friction = c) * 2
            ] * 2
        ] * 2
    ] * 2
]`,
  },
  {
    id: "arms",
    title: "two jointed arms on a body",
    values: { g: 9.81, m: 0.08, l: 0.3, c: 0 },
    release: release(50, 30, 1),
    text: `gravity = g,
body: rod(mass = 0.2, length = 0.25, friction = c) [
    upper: rod(mass = m, length = l, friction = c) [
        lower: rod(mass = m, length = l, friction = c)
    ] * 2
]`,
  },
  {
    id: "driven",
    title: "a driven rod with three bobs",
    values: { g: 9.81, a: 0.3, f: 1.1, m: 0.1, c: 0.001 },
    release: release(0, 0, 1),
    text: `gravity = g,
drive(torque = a * sin(2 * 3.14159265358979 * f * t)),
rod: rod(mass = 0.2, length = 0.4, friction = c) [
    bob: point(mass = m, length = 0.2, friction = c) * 3
]`,
  },
  {
    id: "chain",
    title: "a chain, which has no branches",
    values: { g: 9.81, m: 0.1, l: 0.25, c: 0.0002 },
    release: release(90, 90, 0),
    text: `gravity = g,
first: rod(mass = m, length = l, friction = c) [
    second: rod(mass = m, length = l, friction = c) [
        third: rod(mass = m, length = l, friction = c)
    ]
]`,
  },
];
