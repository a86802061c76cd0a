//! Order of the links of a lineage.

use branched_pendulum_codegen::scene::Lineage;

#[test]
fn each_link_has_one_index_and_copies_fill_the_tree() {
    for generations in 2..12 {
        let own = Lineage { generations };
        let (mut seen, mut copies) = (Vec::new(), 0);
        for generation in 0..generations {
            seen.push(own.open(generation));
            copies += 1;
            for branching in 1..=generation {
                seen.push(own.closed(branching, generation));
                copies += own.copies(branching, generation);
            }
        }
        seen.sort_unstable();
        let links = generations * (generations + 1) / 2;
        assert_eq!(seen, (0..links).collect::<Vec<_>>());
        assert_eq!(copies, (1 << generations) - 1);
    }
}
