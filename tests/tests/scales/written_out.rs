//! Budgets by scale against those of the tree written out.

use super::*;
use branched_pendulum_codegen::Stages;
use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::scene::LinkId;
use branched_pendulum_compiler_tests::source::stages_of;

/// A tree written out, and what of it is where in the model in loops.
struct Written {
    stages: Stages,
    /// Link of the model in loops, by link.
    order: Vec<usize>,
    /// Scale of each sector.
    scales: Vec<usize>,
    /// Place of each sector among all in loops.
    places: Vec<usize>,
}

impl Written {
    fn new<M: Pendulum<f64> + Scales<f64>>(model: &M, text: &str) -> Self {
        let stages = stages_of(&format!(
            "#[branched_pendulum(gravity = 9.80665, code = unrolled, \
             emit(forces, budget(parseval, matrix)), {text})] struct Sample;"
        ));
        let links = &stages.scene.links;
        let names = model.link_names();
        let find = |name: &str| names.iter().position(|other| other == name).unwrap();
        let order: Vec<usize> = links.iter().map(|link| find(&link.name)).collect();
        let depth = |mut link: usize| {
            let mut depth = 0;
            while let Some(LinkId(parent)) = links[link].parent {
                (link, depth) = (parent, depth + 1);
            }
            depth
        };
        let mechanics = &stages.mechanics;
        let sectors = &mechanics.sectors.as_ref().unwrap().sectors;
        let (mut scales, mut places) = (Vec::new(), Vec::new());
        let mut seen: Vec<usize> = Vec::new();
        for sector in sectors {
            let coordinate = &mechanics.coordinates[sector.coordinates[0]];
            let LinkId(first) = coordinate.weights[0].0;
            if scales.is_empty() {
                (scales, places) = (vec![0], vec![0]);
                continue;
            }
            let LinkId(parent) = links[first].parent.unwrap();
            let number = seen.iter().filter(|&&other| other == parent).count();
            seen.push(parent);
            scales.push(depth(first));
            let copies = M::COPIES[1];
            places.push(1 + order[parent] * (copies - 1) + number);
        }
        Self {
            stages,
            order,
            scales,
            places,
        }
    }

    fn evaluate(&self, entry: &str, sample: &Sample) -> Vec<f64> {
        let input = |argument, index: usize| match argument {
            Argument::Time => sample.time,
            Argument::Theta => sample.theta[self.order[index]],
            Argument::Omega => sample.omega[self.order[index]],
            Argument::Torques => sample.torques[self.order[index]],
            other => panic!("{other:?}"),
        };
        let program = &self.stages.program;
        program
            .evaluate(f64::sin_cos, entry, &[], input)
            .expect("an entry of that name")
    }

    /// By scale: energies, transfers, powers; and the matrix of transfers.
    fn budget(&self, sample: &Sample) -> (Vec<[f64; 3]>, Vec<Vec<f64>>) {
        let scales = self.scales.iter().max().unwrap() + 1;
        let count = self.scales.len();
        let shares = self.evaluate("budget_parseval_under", sample);
        let matrix = self.evaluate("sector_transfer_matrix", sample);
        let mut sums = vec![[0.0; 3]; scales];
        let mut transfers = vec![vec![0.0; scales]; scales];
        for (sector, &scale) in self.scales.iter().enumerate() {
            for (kind, sum) in sums[scale].iter_mut().enumerate() {
                *sum += shares[kind * count + sector];
            }
            for (other, &from) in self.scales.iter().enumerate() {
                transfers[scale][from] += matrix[sector * count + other];
            }
        }
        (sums, transfers)
    }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| most.max(value.abs()))
}

/// All entries to 1e-13 of the largest of their kind.
fn agree<M>(model: &M, text: &str, count: usize)
where
    M: Pendulum<f64> + Scales<f64>,
{
    let written = Written::new(model, text);
    let mut worst = [0.0_f64; 4];
    for sample in samples(model.links(), count) {
        let (sums, transfers) = written.budget(&sample);
        let own = budget(model, &sample);
        assert_eq!(own.scales(), sums.len());
        let mut compare = |kind: usize, pairs: Vec<(f64, f64)>| {
            let size = largest(pairs.iter().map(|pair| pair.1));
            let error = largest(pairs.iter().map(|pair| pair.0 - pair.1));
            worst[kind] = worst[kind].max(error / size);
        };
        let each = |own: &dyn Fn(usize) -> f64, kind: usize| {
            let sums = sums.iter().enumerate();
            sums.map(|(scale, sums)| (own(scale), sums[kind])).collect()
        };
        compare(0, each(&|scale| own.energy(scale), 0));
        compare(2, each(&|scale| own.power(scale), 2));
        let mut entries = each(&|scale| own.received(scale), 1);
        for (to, row) in transfers.iter().enumerate() {
            for (from, &entry) in row.iter().enumerate() {
                entries.push((own.transfer(from, to), entry));
            }
        }
        compare(1, entries);
        let shares = written.evaluate("budget_parseval_under", &sample);
        let mut sectors = vec![0.0; written.places.len()];
        model.energies_by_sector(
            &mut Workspace::new(),
            &sample.theta,
            &sample.omega,
            &mut sectors,
        );
        let places = written.places.iter().enumerate();
        compare(
            3,
            places
                .map(|(sector, &place)| (sectors[place], shares[sector]))
                .collect(),
        );
    }
    let [energies, transfers, powers, sectors] = worst;
    println!(
        "{} links: energies {energies:.1e}, transfers {transfers:.1e}, powers {powers:.1e}, \
         sectors {sectors:.1e}",
        model.links()
    );
    assert!(worst.iter().all(|&error| error < 1e-13), "{worst:?}");
}

#[test]
fn seven_links() {
    agree(&Seven::new(), SEVEN, 50);
}

#[test]
fn fifteen_links_with_all_forces() {
    agree(&Fifteen::new(), FIFTEEN, 50);
}

#[test]
fn thirty_one_links() {
    agree(&ThirtyOne::new(), THIRTY_ONE, 20);
}

#[test]
fn thirteen_links_in_threes() {
    agree(&Thirteen::new(), THIRTEEN, 50);
}

#[test]
fn links_with_springs_and_friction_between_them() {
    agree(&Coupled::new(), COUPLED, 50);
    agree(&CoupledThrees::new(), COUPLED_THREES, 50);
}

#[test]
fn thirteen_links_with_friction_of_all_kinds() {
    agree(&Braked::new(), BRAKED, 50);
}
