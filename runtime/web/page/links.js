// Where paper, book and repository are: the one place for their addresses. One without an address
// is named and not linked.

const LINKS = [
  {
    text: "The paper: Y. Toda and T. Ooshida, Experimental detection of energy transfer into the anti-phase mode in a branched double pendulum",
    address: null,
  },
  { text: "The book", address: null },
  { text: "The repository", address: null },
];

/** Shows them in an element. */
export function showLinks(place) {
  const shown = LINKS.map(({ text, address }) => {
    const link = document.createElement(address ? "a" : "span");
    if (address) link.href = address;
    link.textContent = text;
    return link;
  });
  place.replaceChildren(...shown.filter((_, index) => index === 0 || LINKS[index].address));
}
