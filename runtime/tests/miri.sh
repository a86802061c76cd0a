#!/usr/bin/env bash
# The runtime's unsafe code on small trees, under Miri, which stops at undefined behaviour: needs
# `rustup toolchain install nightly --component miri`. Miri has no AVX, so the registers are the build's.
# Tests that take more than a minute there are left out: those named run.
set -euo pipefail
cd "$(dirname "$0")/../.."
cargo +nightly miri --version > /dev/null 2>&1 || { echo "not checked: Miri is not installed"; exit 1; }
tests=(
    scalar::sincos::tests::tiny_angles_are_their_own_sines
    scalar::sincos::tests::zeros_keep_their_sign_and_what_is_no_angle_gives_nan
    scalar::wide::tests::a_product_holds_twice_the_bits
    scalar::wide::tests::operations_undo_each_other_to_the_last_bits
    scalar::wide::tests::what_is_no_number_stays_none
    sectors::scales::tests::degrees_of_freedom_are_those_of_all_links
    sectors::tests::norm_and_value_of_a_second_difference
    system::tests::a_state_of_wrong_length_gets_nan_and_no_panic
    system::tests::adapters_put_velocities_first_and_accelerations_second
    system::tests::halves_of_a_state
    tree::scales::shape::tests::parts_stand_one_behind_the_other
    tree::strips::tests::no_run_goes_beyond_what_is_asked_for
    tree::tests::dense::parents_behind_their_links_are_no_parents
    tree::tests::energies::energies_have_the_same_bits_in_registers_and_one_by_one
    tree::tests::energies::powers_of_one_link_are_those_of_its_torques
    tree::tests::energies::rows_that_are_lacking_give_nan
    tree::tests::without_torques_from_outside_they_are_zero
)
cargo +nightly miri test -p branched-pendulum --no-default-features --features std --lib -- \
    --exact "${tests[@]}"
