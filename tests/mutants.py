#!/usr/bin/env python3
"""Mutants of the physics and the integrators, and the tests that kill them.

    tests/mutants.py --check        each mutant's text stands once in the source
    tests/mutants.py --list         the table of README.md
    tests/mutants.py COPY [NAME…]   runs mutants in COPY, a copy of this repository
    tests/mutants.py --killers COPY [NAME…]
                                    runs all tests of each mutant's binary, and lists those that
                                    kill it, and then the tests that are the only ones for a mutant

A run puts all mutants of expressions into COPY at once, each behind a switch that the
environment sets, and so builds every test binary once. A binary whose tests see emitted code
alone is built once more for each mutant of the compiler. Mutants of constants are built
together, since each has a test that sees no other of them. A mutant that its test does
not kill is an error.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Test binaries, by the names of their targets.
MECHANICS = "mechanics"
FRONT_END = "front_end"
GENERATED = "generated"
LINK = "link"
LIBRARY = "branched_pendulum"
RUNTIME = "runtime"
INTEGRATORS = "integrators"
DATA = "data"
MEASURE = "measure"
PROGRAM = "branched_pendulum_program"
OUTSIDE = "outside"
LIBRARIES = {LIBRARY, PROGRAM}
# Sees mutants of the compiler only in code that was emitted with them.
EMITTED = {OUTSIDE}

BOTH_SOLVES = "solves::both_agree_with_the_oracle_and_each_other"
DRIVEN = "drive::accelerations_and_power_agree_with_both_oracles"
BETWEEN = "between::motions_are_those_of_bodies"
CARTESIAN = "random_trees::accelerations_agree_with_cartesian_jacobians"

C, R, D, M = "codegen/src", "runtime/src", "runtime/data/src", "runtime/measure/src"
T, P = "runtime/trees/src", "runtime/program/src"

# Name, file, text, mutant, test binary, test.
EXPRESSIONS = [
    ("sign of the Coriolis term", f"{C}/mechanics/frame.rs",
     "rows[self.index(coordinate)].push(-slope);", "rows[self.index(coordinate)].push(slope);",
     MECHANICS, BOTH_SOLVES),
    ("sign of gravity", f"{C}/mechanics/frame.rs",
     "row.push(potential);", "row.push(-potential);", MECHANICS, BOTH_SOLVES),
    ("friction pushes", f"{C}/mechanics/frame.rs",
     "row.push(-dissipative);", "row.push(dissipative);", MECHANICS, CARTESIAN),
    ("sign of the drive", f"{C}/mechanics/frame.rs",
     "row.push(-drive);", "row.push(drive);", MECHANICS, DRIVEN),
    ("half of K on the diagonal", f"{C}/mechanics/frame.rs",
     "Formula::integer(2).pow(-1)", "Formula::integer(1)", MECHANICS,
     "random_trees::energies_agree_with_velocities_and_heights"),
    ("inertia about the centre of mass missing", f"{C}/mechanics/lagrangian.rs",
     "sums.add(index, index, inertia);", "sums.add(index, index, Formula::zero());",
     MECHANICS, BOTH_SOLVES),
    ("friction against the ground instead of the parent", f"{C}/mechanics/force_elements.rs",
     "self.joint_rate(link, velocities)", "Formula::symbol(velocities[link])",
     MECHANICS, CARTESIAN),
    ("static friction that grows with the rate", f"{C}/program/friction.rs",
     "let excess = self.mul(law.excess, stribeck);", "let excess = self.mul(law.excess, square);",
     MECHANICS, "friction::accelerations_agree_with_cartesian_jacobians"),
    ("static friction of differences", f"{C}/program/symmetric/friction.rs",
     "let most = self.series.mul(&law.excess, &stribeck);",
     "let most = self.series.mul(&law.excess, &law.stribeck);",
     MECHANICS, "friction::symmetric::symmetric_accelerations_are_those_of_the_links"),
    ("static friction at any rate", f"{R}/friction.rs",
     "self.coulomb * sum + self.excess * square", "self.coulomb * sum + self.excess * sum",
     MECHANICS, "between::functions_are_those_of_trees_at_run_time"),
    ("sign of rest angles", f"{C}/program/lower.rs",
     "self.builder.sub(value, rest)", "self.builder.add(value, rest)", MECHANICS, CARTESIAN),
    ("torque between links on the second one", f"{C}/program/link/torques.rs",
     "builder.add(torques[other.0], other.1)", "builder.sub(torques[other.0], other.1)",
     MECHANICS, BETWEEN),
    ("weights of springs between copies", f"{C}/program/symmetric/spring_dampers.rs",
     "weight * weight", "weight.abs()", MECHANICS,
     "between::sectors::budgets_are_those_of_trees_at_run_time"),
    ("places of siblings in loops", f"{C}/scene/link_pairs.rs",
     "start + copy * above", "start + copy", GENERATED,
     "loops::coupled::a_rule_agrees_with_the_tree_at_run_time"),
    ("springs on one coordinate of a sector", f"{R}/transfer/springs.rs",
     "own.spring * square / norm(term.column)", "own.spring * square", MECHANICS,
     "between::sectors::transfers_into_leaves_are_those_of_trees_at_run_time"),
    ("rest angles of springs within a sector", f"{R}/transfer/springs.rs",
     "angle - own.rest", "angle + own.rest", MECHANICS,
     "between::sectors::springs_within_sectors_are_theirs"),
    ("sign of lateral levers", f"{C}/mechanics/positions.rs",
     "&(along * &sin) + &(across * &cos)", "&(along * &sin) - &(across * &cos)",
     MECHANICS, CARTESIAN),
    ("torque from outside pulls", f"{C}/program/choice.rs",
     "self.builder.add(outside, torque)", "self.builder.sub(torque, outside)",
     MECHANICS, "outside::torques_from_outside_add_to_the_equations_of_motion"),
    ("torque from outside pulls in loops", f"{C}/program/link/functions.rs",
     "builder.add(pushed, outside)", "builder.sub(pushed, outside)",
     OUTSIDE, "balance::of_trees_in_loops_over_links"),
    ("weight in the reaction of a prescribed link", f"{C}/program/link/prescribed.rs",
     "builder.sub(self.steady_torque, pull)", "builder.add(self.steady_torque, pull)",
     OUTSIDE, "prescribed::the_free_tree_moves_so_under_the_reactions"),
    ("weight of straight springs between copies", f"{C}/mechanics/chords.rs",
     "&Formula::integer(count as i64) * &self.quantity(&own.strength)", "self.quantity(&own.strength)", MECHANICS,
     "between::chords::a_pair_has_the_closed_form"),
    ("sign of the torque between copies", f"{C}/program/symmetric/chords.rs",
     "self.sub(&across, &down)", "self.sub(&down, &across)", MECHANICS,
     "between::chords::symmetric_coordinates_describe_the_same_motion"),
    ("torque of one copy for all", f"{R}/system/whole_tree.rs",
     "*sum + torque", "torque", OUTSIDE,
     "reduced::accelerations_are_those_of_the_whole_tree"),
    ("copies of locked links in the whole tree", f"{R}/system/whole_tree.rs",
     "above.apart * copies + copy", "above.apart + copy", MECHANICS,
     "reductions::copies_on_locked_copies_are_told_apart"),
    ("reaction of a joint on the parent", f"{C}/program/link/torques.rs",
     "builder.add(torques[parent], torque)", "builder.sub(torques[parent], torque)",
     MECHANICS, BOTH_SOLVES),
    ("sign of the pivot's vertical acceleration", f"{C}/mechanics/drive.rs",
     "work.push(-(&y * &upwards));", "work.push(&y * &upwards);", MECHANICS, DRIVEN),
    ("derivative of the cosine in time", f"{C}/mechanics/drive.rs",
     "-(&sin * &self.time_derivative(argument))", "(&sin * &self.time_derivative(argument))",
     MECHANICS, DRIVEN),
    ("sign in the Poisson bracket", f"{C}/mechanics/bracket.rs",
     "[forward, -backward]", "[forward, backward]", MECHANICS,
     "paper::energy_transfer_to_second_order_in_the_amplitude"),
    ("weight of gravity in H_d", f"{C}/mechanics/transfer.rs",
     "Formula::integer(2 * norm)", "Formula::integer(norm)", MECHANICS, "paper::sub_hamiltonian"),
    ("signs of differences", f"{C}/scene/coordinates.rs",
     "if copy < index { 1 } else { -(index as i64) }",
     "if copy < index { -1 } else { index as i64 }", MECHANICS,
     "symmetric::coordinates_of_a_pair_and_of_a_triple"),
    ("order of children", f"{C}/scene/expand.rs",
     "siblings.push(index);", "siblings.insert(0, index);", FRONT_END, "scenes::nested_copies"),
    ("weights of sectors in products", f"{C}/program/symmetric/field.rs",
     "Rational::from_ratio((index * (index + 1)) as i64, count as i64)",
     "Rational::from_ratio((index * index) as i64, count as i64)", MECHANICS,
     "sectors::energies::energies_by_parseval_sum_to_the_energy"),
    ("weights of sectors in the potential", f"{C}/program/symmetric/potential.rs",
     "self.series.mul(&half, &norm)", "half", MECHANICS,
     "sectors::energies::energies_agree_with_dense_matrices"),
    ("sign of a fused product", f"{C}/program/fuse.rs",
     "minus_product: minus,", "minus_product: false,", MECHANICS, BOTH_SOLVES),
    ("torque of a joint in loops", f"{C}/program/link/functions.rs",
     "builder.add(joint, dragged)", "builder.sub(joint, dragged)", LINK, ""),
    ("weights of the classical method", f"{R}/integrate/fixed/rk4.rs",
     "span.step / W::from_f64(6.0)", "span.step / W::from_f64(6.000_001)", RUNTIME,
     "order::the_classical_method_has_order_four"),
    ("a rising event that is hit exactly is missed", f"{R}/integrate/events/search.rs",
     "left.value < T::ZERO && right.value >= T::ZERO",
     "left.value < T::ZERO && right.value > T::ZERO", INTEGRATORS, "events::"),
    ("falling events are missed", f"{R}/integrate/events/search.rs",
     "left.value > T::ZERO && right.value <= T::ZERO", "false", INTEGRATORS, "events::directions"),
    ("a start on a zero has no side", f"{R}/integrate/events/search.rs",
     "left.value != T::ZERO", "true", INTEGRATORS, "events::a_function_leaves_a_zero_to_a_side"),
    ("an event beside the last one is lost", f"{R}/integrate/events/search.rs",
     "self.found[first..].iter().take_while(at_once).count()", "1", RUNTIME,
     "restarts::times_a_few_units_of_rounding_apart_are_one"),
    ("the step after a cut one is the cut one's", f"{R}/integrate/control.rs",
     "proposed.max(planned)", "proposed", INTEGRATORS,
     "backwards::the_step_after_a_cut_one_is_the_planned_one"),
    ("last states of a batch", f"{R}/batch/blocks.rs",
     "let end = next.min(last) + R::LANES;", "let end = next + R::LANES;", GENERATED,
     "scalars::batches_have_the_bits_of_single_states"),
    ("product rule", f"{R}/scalar/dual.rs", "a * y + x * b", "a * y - x * b", MECHANICS,
     "transverse::differences_are_those_of_the_whole_tree"),
    ("derivative of the cosine", f"{R}/scalar/dual.rs",
     "self.chain(cosine, -sine)", "self.chain(cosine, sine)", MECHANICS,
     "transverse::differences_are_those_of_the_whole_tree"),
    ("rounding error of a sum", f"{R}/scalar/wide/mod.rs",
     "(a - (sum - other)) + (b - other)", "b - other", LIBRARY, "scalar::wide::tests"),
    ("compensation of steps", f"{R}/integrate/explicit/stages.rs",
     "two_sum(start[i], change)", "(start[i] + change, change - change)", RUNTIME,
     "accuracy::compensated_sums_lose_less"),
    ("frequencies in radians", f"{R}/analysis/modes.rs",
     "squared.sqrt() / TAU", "squared.sqrt()", RUNTIME,
     "modes::the_paper_s_frequencies_to_seven_digits"),
    ("degrees are gradians", f"{D}/units.rs", "PI / 180.0", "PI / 200.0", DATA,
     "cells::units_of_angles_are_radians"),
    ("hours of a clock are minutes", f"{D}/cell.rs",
     "3600.0 * whole(hours, 24)?", "60.0 * whole(hours, 24)?", DATA,
     "cells::numbers_are_read_as_they_are_written"),
    ("links point from the origin", f"{D}/points.rs",
     "([c - a, d - b], one.min(other))", "([c, d], one.min(other))", DATA, "points::"),
    ("the first of repeated rows counts as the last", f"{D}/succession.rs",
     "is_kept[first..row].fill(false)", "is_kept[row] = false", DATA,
     "headers::repeated_times_leave_the_row_that_counts"),
    ("turns are told without looking ahead", f"{D}/turns.rs",
     "let expected = self.value + ahead;", "let expected = self.value;", DATA,
     "findings::turns_are_counted_ahead"),
    ("a wrong picture counts among the turns", f"{D}/turns.rs",
     "*bend > limit", "false", DATA, "findings::a_glitch_adds_no_turn"),
    ("no samples are lost between two", f"{D}/timing.rs",
     "gap.end <= to", "false", DATA,
     "findings::rows_at_the_edges_of_an_encoder"),
    ("outliers of rounding", f"{D}/outliers.rs",
     "(NORMAL * median(deviations.clone())).max(ROUNDING * resolution)",
     "NORMAL * median(deviations.clone())", DATA,
     "findings::rounding_makes_no_outliers"),
    ("an exchange that goes on", f"{D}/exchange.rs",
     "let turned = difference.plus(-2.0, difference);", "let turned = difference;", DATA,
     "exchanges::exchanged_columns_are_changed_back"),
    ("dots that jump together are exchanged", f"{D}/exchange.rs",
     "!sums.is_far(distance)", "true", DATA,
     "exchanges::one_dot_that_is_wrong_is_no_exchange"),
    ("the rate of rounded times", f"{D}/timing.rs",
     "usual.iter().map(|&index| steps[index]).sum::<f64>() / count", "middle", DATA,
     "findings::the_rate_of_rounded_times"),
    ("modes about any angles", f"{R}/analysis/modes.rs",
     "torque.abs() <= MISSED * stiffest", "true", RUNTIME, "modes::modes_are_about_rest"),
    ("variance about the samples' own mean not corrected", f"{R}/analysis/statistics/average.rs",
     "variance / (1.0 - time / number)", "variance", RUNTIME,
     "statistics::averages_know_variance_and_error"),
    ("plateau of blocking by the second power", f"{R}/analysis/statistics/blocking.rs",
     "ratio.powi(4)", "ratio.powi(2)", RUNTIME, "statistics::blocks_know_the_error"),
    ("uncertainty of the error of blocks", f"{R}/analysis/statistics/blocking.rs",
     "error / (2.0 * free).sqrt()", "error / free.sqrt()", RUNTIME,
     "statistics::blocks_know_the_error"),
    ("error of a drift that of a half", f"{R}/analysis/statistics/transient.rs",
     "first.error.hypot(second.error)", "first.error", RUNTIME,
     "statistics::drifts_and_left_out_members_know_their_errors"),
    ("weight of members left out", f"{R}/analysis/statistics/jackknife.rs",
     "(number - 1.0) / number * squares", "squares / number", RUNTIME,
     "statistics::drifts_and_left_out_members_know_their_errors"),
    ("slope of the squared difference halved", f"{R}/analysis/growth/record.rs",
     "2.0 * dot(angles, rates)", "dot(angles, rates)", LIBRARY, "growth::record"),
    ("factorials of the jerk's noise", f"{M}/smoothing/kinematic.rs",
     "power as f64 * factorial[2 - i] * factorial[2 - j]", "power as f64", MEASURE,
     "dense_regression::a_white_jerk"),
    ("noise of angles by white torques", f"{M}/smoothing/model_filter.rs",
     "h.powi(3) / 3.0", "h.powi(3) / 2.0", MEASURE, "dense_regression::white_torques"),
    ("deviations along the first coordinates", f"{R}/analysis/variational/lyapunov.rs",
     "let mut vectors: Vec<f64> = parts.collect();",
     "let mut vectors: Vec<f64> = nalgebra::DMatrix::identity(dimension, count).as_slice().to_vec();",
     RUNTIME, "exponents::the_paper_s_pendulum_in_phase"),
    ("all deviations for those within a subspace", f"{R}/analysis/variational/deviations.rs",
     "self.keep(vectors, n);", "();", RUNTIME,
     "exponents::the_paper_s_pendulum_in_phase"),
    ("order of exponents", f"{R}/analysis/variational/lyapunov.rs",
     "other.total_cmp(one)", "one.total_cmp(other)", RUNTIME,
     "exponents::the_largest_exponent_is_found_wherever_it_is"),
    ("size of what is left over in naive deviations",
     f"{M}/identification/covariance.rs",
     "variance * row.norm_squared()", "row.norm_squared()", MEASURE,
     "identification::deviations::bars_hold_the_truth"),
    ("frequencies that weigh by no errors of angles", f"{M}/identification/frequencies.rs",
     "beside * own.residual()", "own.residual()", MEASURE,
     "identification::frequencies::a_record_and_frequencies_weigh_by_their_errors"),
    ("simultaneous events of a run backwards", f"{R}/integrate/events/search.rs",
     "(further - end) * length > T::ZERO", "further - end > T::ZERO", INTEGRATORS,
     "events::rough_crossings_at_one_time_are_visited_there"),
    ("sum for the mean of the decay", f"{T}/in_phase/growth.rs",
     "-rates.iter().skip(2 * all - own).sum::<f64>() / own as f64",
     "-rates.iter().skip(2 * all - own).sum::<f64>()", MECHANICS,
     "run_time::growth::decay_of_a_difference_is_the_mean_of_its_links"),
    ("links of the first line of a run for all", f"{R}/translational/mod.rs",
     "arm.link += place;", "();", RUNTIME, "runs::runs_of_lines_are_the_lines_one_by_one"),
    ("size off the blocks in units of mass", f"{R}/analysis/sector_modes.rs",
     "largest / scale", "largest", RUNTIME,
     "sector_modes::what_couples_the_sectors_depends_on_no_unit"),
    ("relative error bars by blocks of ratios", f"{M}/identification/ratios.rs",
     "by_blocks: by_blocks.map(|own| own[row] * value.abs()),",
     "by_blocks: by_blocks.map(|own| own[row]),", MEASURE,
     "identification::deviations::deviations_of_ratios_hold_the_truth"),
    ("few blocks suffice for error bars", f"{M}/identification/covariance.rs",
     "count < free.len() + 2", "count < 2", MEASURE,
     "identification::deviations::few_blocks_have_no_error_bars"),
    ("power of the drive in budgets", f"{P}/budget.rs",
     "acting.extend(tree.drive(*time).map(NonConservative::Drive));", "();", PROGRAM,
     "budget::tests::the_budget_of_a_driven_tree_closes"),
]

CONSTANTS = [
    ("a node of DOP853 in the 12th digit", f"{R}/integrate/explicit/dop853/tables.rs",
     "0.526001519587677318785587544488e-01", "0.526001519588677318785587544488e-01",
     LIBRARY, "dop853"),
    ("a coefficient of Dormand and Prince", f"{R}/integrate/explicit/dopri5/tables.rs",
     "-25360.0 / 2187.0", "-25360.0 / 2187.000_000_01", LIBRARY, "dopri5"),
    ("a node of Verner's method in the 12th digit", f"{R}/integrate/explicit/verner98/tables.rs",
     "0.5538640526394373", "0.5538640526404373", LIBRARY, "verner98"),
    ("a node of Gauss in the 12th digit", f"{R}/integrate/piece/collocation/tables.rs",
     "nodes: &[0.2113248654051871,", "nodes: &[0.2113248654061871,", LIBRARY, "collocation::tables"),
    ("correlation of sine and cosine of a line", f"{M}/spectrum/fit.rs",
     "2.0 * c * s * all[(first, first + 1)]", "0.0 * c * s * all[(first, first + 1)]",
     MEASURE, "units::fit"),
    ("minutes are seconds", f"{D}/units.rs",
     '(&["min", "minutes"], Unit::Time(60.0))', '(&["min", "minutes"], Unit::Time(1.0))', DATA,
     "cells::units_of_time_are_seconds"),
]

SWITCH = """
#[doc(hidden)]
#[allow(missing_docs)]
pub fn mutant(number: u32) -> bool {
    extern crate std;
    static CHOSEN: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    *CHOSEN.get_or_init(|| {
        let text = std::env::var("MUTANT").unwrap_or_default();
        text.parse().unwrap_or(0)
    }) == number
}
"""


def source(root, file, text):
    """The text of a file in which `text` stands once."""
    content = (root / file).read_text()
    if content.count(text) != 1:
        sys.exit(f"{file}: `{text}` stands there {content.count(text)} times")
    return content


def switched(number, text, mutant):
    """Either text, by the number that the environment gives."""
    test = f"crate::mutant({number})"
    if text.startswith("let "):
        name, value = text.removesuffix(";").split(" = ", 1)
        _, other = mutant.removesuffix(";").split(" = ", 1)
        return f"{name} = if {test} {{ {other} }} else {{ {value} }};"
    if text.endswith(","):
        name, value = text.removesuffix(",").split(": ", 1)
        _, other = mutant.removesuffix(",").split(": ", 1)
        return f"{name}: if {test} {{ {other} }} else {{ {value} }},"
    if text.endswith(";"):
        return f"if {test} {{ {mutant} }} else {{ {text} }}"
    return f"(if {test} {{ {mutant} }} else {{ {text} }})"


def build(copy, binaries, number=0):
    """Builds test binaries, and returns the folder of each one's package and its file.

    Macros that are expanded in this build contain mutant `number`.
    """
    targets = [["--lib"] if name in LIBRARIES else ["--test", name] for name in sorted(binaries)]
    command = ["cargo", "test", "--workspace", *sum(targets, []), "--no-run", "--message-format=json"]
    environment = dict(os.environ, MUTANT=str(number), BRANCHED_PENDULUM_CACHE="off")
    built = subprocess.run(command, cwd=copy, env=environment, stdout=subprocess.PIPE, text=True)
    if built.returncode != 0:
        sys.exit("the mutants do not compile")
    messages = map(json.loads, built.stdout.splitlines())
    return {
        message["target"]["name"]: (Path(message["manifest_path"]).parent, message["executable"])
        for message in messages
        if message["reason"] == "compiler-artifact" and message["profile"]["test"]
    }


def expanded(copy, number, binary):
    """Builds a test binary once more, whose emitted code has mutant `number`."""
    for folder in ["tests/src", f"tests/tests/{binary}"]:
        for file in (copy / folder).rglob("*.rs"):
            file.touch()
    return build(copy, [binary], number)[binary]


def killers(number, folder, executable, test):
    """The tests that fail with this mutant, among those whose names contain `test`."""
    environment = dict(os.environ, MUTANT=str(number), BRANCHED_PENDULUM_CACHE="off")
    run = subprocess.run([executable, test], cwd=folder, env=environment, capture_output=True, text=True)
    if "running 0 tests" in run.stdout:
        sys.exit(f"no test `{test}`")
    failed = re.findall(r"^test (\S+) .*FAILED$", run.stdout, re.MULTILINE)
    if run.returncode != 0 and not failed:
        failed = ["(the process ended)"]
    return failed


def is_emitted(mutant):
    """True if the mutant's test sees it in emitted code alone."""
    _, file, _, _, binary, _ = mutant
    return binary in EMITTED and file.startswith(C)


def run(copy, wanted, all_tests):
    chosen = [m for m in EXPRESSIONS if not wanted or m[0] in wanted]
    constants = [m for m in CONSTANTS if not wanted or m[0] in wanted]
    originals = {}
    survivors, alone = [], {}

    def judge(name, number, place, test):
        found = killers(number, *place, "" if all_tests else test)
        print("killed" if found else "SURVIVED", name, flush=True)
        if all_tests:
            print("".join(f"    {test}\n" for test in found), end="", flush=True)
        if not found:
            survivors.append(name)
        if len(found) == 1:
            alone.setdefault(found[0], []).append(name)

    try:
        for package in {m[1].split("/src")[0] for m in chosen}:
            file = f"{package}/src/lib.rs"
            originals[file] = (copy / file).read_text()
            (copy / file).write_text(originals[file] + SWITCH)
        for name, file, text, mutant, *_ in chosen:
            content = source(copy, file, text)
            originals.setdefault(file, content)
            number = 1 + [m[0] for m in EXPRESSIONS].index(name)
            (copy / file).write_text(content.replace(text, switched(number, text, mutant)))
        binaries = build(copy, {m[4] for m in chosen}) if chosen else {}
        # Those that are built anew come last.
        chosen.sort(key=is_emitted)
        for name, file, text, mutant, binary, test in chosen:
            number = 1 + [m[0] for m in EXPRESSIONS].index(name)
            own = is_emitted((name, file, text, mutant, binary, test))
            place = expanded(copy, number, binary) if own else binaries[binary]
            judge(name, number, place, test)
    finally:
        for file, content in originals.items():
            (copy / file).write_text(content)
    originals = {}
    try:
        for _, file, text, mutant, *_ in constants:
            originals[file] = source(copy, file, text)
            (copy / file).write_text(originals[file].replace(text, mutant))
        binaries = build(copy, {m[4] for m in constants}) if constants else {}
        for name, _, _, _, binary, test in constants:
            judge(name, 0, binaries[binary], test)
    finally:
        for file, content in originals.items():
            (copy / file).write_text(content)
    if all_tests:
        print("\ntests that are the only ones of their binary to kill a mutant")
        for test, names in sorted(alone.items()):
            print(f"| `{test}` | {'; '.join(names)} |")
    sys.exit(f"{len(survivors)} survived" if survivors else 0)


def main(arguments):
    if arguments == ["--check"]:
        for _, file, text, *_ in EXPRESSIONS + CONSTANTS:
            source(ROOT, file, text)
    elif arguments == ["--list"]:
        for name, file, _, _, _, test in EXPRESSIONS + CONSTANTS:
            print(f"| {name} | `{file}` | `{test or 'link'}` |")
    elif len(arguments) > 1 and arguments[0] == "--killers":
        run(Path(arguments[1]), arguments[2:], True)
    elif arguments and not arguments[0].startswith("-"):
        run(Path(arguments[0]), arguments[1:], False)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
