//! The equations, taken through a tree of any shape, with constants of each link: a
//! strip is all links of one height.

#![allow(unsafe_code)]

use super::passes::{Passes, add};
use super::strip::{Output, Places};
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::columns::{read, write};
use crate::tree::equations::{LinkEquations, LinkMotion, Row};
use crate::tree::strips::{Attachment, Strip};

// SAFETY, for all of this: as for all passes; the places of links are those of the
// strips.
impl<E, N, T, V> Passes<'_, E, N, T, V>
where
    E: LinkEquations,
    N: Scalar,
    T: Scalar + Simd<N>,
    V: Simd<T>,
{
    /// From the lowest strip to the root.
    #[inline(always)]
    pub(super) fn heights_up(&self) {
        let one = Passes::<E, N, T, V::One>::of(self.view);
        let mut strips = self.strips;
        while let Some((strip, before)) = strips.split_last() {
            if Self::is_short(strip) {
                one.one_by_one_up(strip);
            } else {
                self.links_up(strip);
                self.attach(strip);
            }
            strips = before;
        }
    }

    /// From the root to the lowest strip.
    #[inline(always)]
    pub(super) fn heights_down(&self, out: &mut impl Output<T>) {
        let one = Passes::<E, N, T, V::One>::of(self.view);
        let mut strips = self.strips;
        while let Some((strip, behind)) = strips.split_first() {
            if Self::is_short(strip) {
                one.one_by_one_down(strip, out);
            } else {
                self.hand_down(strip);
                self.links_down(strip, out);
            }
            strips = behind;
        }
    }

    /// The links are too few for a register: they go one by one, and what is written
    /// narrow is read narrow soon.
    #[inline(always)]
    fn is_short(strip: &Strip) -> bool {
        V::LANES == 1 || strip.length < V::LANES
    }

    /// A strip of links with constants of their own, up, in vectors of one; each link's
    /// response goes to the parent at once.
    #[inline(always)]
    fn one_by_one_up(&self, strip: &Strip) {
        if strip.first.own == 0 {
            // SAFETY: see the top.
            let _ = unsafe { self.response(strip, 0) };
        }
        let (from, to) = strip.attachments;
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at < attachment.length {
                // SAFETY: see the top.
                let response = unsafe { self.response(strip, attachment.child + at) };
                // SAFETY: see the top.
                unsafe { self.attach_at(attachment, at, response) };
                at += 1;
            }
        }
    }

    /// The same down.
    #[inline(always)]
    fn one_by_one_down(&self, strip: &Strip, out: &mut impl Output<T>) {
        if let (0, Some([x, y])) = (strip.first.own, &self.view.root) {
            let pivot = [V::splat(*x), V::splat(*y)];
            // SAFETY: see the top.
            unsafe { self.accelerate(strip, 0, pivot, out) };
        }
        let (from, to) = strip.attachments;
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at < attachment.length {
                // SAFETY: see the top.
                let pivot = unsafe { self.pivot_at(attachment, at) };
                // SAFETY: see the top.
                unsafe { self.accelerate(strip, attachment.child + at, pivot, out) };
                at += 1;
            }
        }
    }

    /// The responses of the links of a strip from the place `at` on.
    #[inline(always)]
    unsafe fn response(&self, strip: &Strip, at: usize) -> E::Response<V> {
        let (view, slots) = (self.view, self.view.slots);
        // SAFETY: see the top.
        let (constants, link) = unsafe { (self.constants(at), self.motion(at, E::JOINTS)) };
        if strip.copies == 0 {
            return E::leaf(&constants, link);
        }
        // SAFETY: see the top.
        let sums = unsafe { read(view.sums.add(at), slots) };
        let (response, elimination) = E::inner(&constants, link, sums);
        // SAFETY: see the top.
        unsafe { write(&elimination, view.eliminations.add(at), slots) };
        response
    }

    /// Writes the accelerations of the links of a strip from the place `at` on, and
    /// what they hand to their children.
    #[inline(always)]
    unsafe fn accelerate(&self, strip: &Strip, at: usize, pivot: [V; 2], out: &mut impl Output<T>) {
        let (view, slots) = (self.view, self.view.slots);
        // SAFETY: see the top.
        let (constants, link) = unsafe { (self.constants(at), self.motion(at, E::JOINTS)) };
        if strip.copies == 0 {
            let acceleration = E::accelerate_leaf(&constants, link, pivot);
            // SAFETY: see the top.
            unsafe { out.write(at, acceleration, V::LANES) };
            return;
        }
        // SAFETY: see the top.
        let elimination = unsafe { read(view.eliminations.add(at), slots) };
        let (acceleration, carried) = E::accelerate(&constants, link, elimination, pivot);
        // SAFETY: see the top.
        unsafe { out.write(at, acceleration, V::LANES) };
        // SAFETY: see the top.
        unsafe { write(&carried, view.sums.add(at), slots) };
    }

    /// A strip of links with constants of their own, up.
    #[inline(always)]
    fn links_up(&self, strip: &Strip) {
        let (view, mut places) = (self.view, Places::of::<T, V>(strip.length));
        while let Some(place) = places.next() {
            let at = strip.first.own + place;
            // SAFETY: see the top.
            let response = unsafe { self.response(strip, at) };
            // SAFETY: see the top.
            unsafe { write(&response, view.responses.add(at), view.slots) };
        }
    }

    /// The same down; the accelerations of pivots are in memory.
    #[inline(always)]
    fn links_down(&self, strip: &Strip, out: &mut impl Output<T>) {
        let (view, mut places) = (self.view, Places::of::<T, V>(strip.length));
        while let Some(place) = places.next() {
            let at = strip.first.own + place;
            // SAFETY: see the top.
            let pivot = unsafe { read(view.responses.add(at), view.slots) };
            // SAFETY: see the top.
            unsafe { self.accelerate(strip, at, pivot, out) };
        }
    }

    /// Adds the responses of a strip to the sums of the parents.
    #[inline(always)]
    fn attach(&self, strip: &Strip) {
        let one = Passes::<E, N, T, V::One>::of(self.view);
        let (view, (from, to)) = (self.view, strip.attachments);
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at + V::LANES <= attachment.length {
                // SAFETY: see the top.
                let response =
                    unsafe { read(view.responses.add(attachment.child + at), view.slots) };
                // SAFETY: see the top.
                unsafe { self.attach_at(attachment, at, response) };
                at += V::LANES;
            }
            while at < attachment.length {
                // SAFETY: see the top.
                let response =
                    unsafe { read(view.responses.add(attachment.child + at), view.slots) };
                // SAFETY: see the top.
                unsafe { one.attach_at(attachment, at, response) };
                at += 1;
            }
        }
    }

    #[inline(always)]
    unsafe fn attach_at(&self, attachment: &Attachment, at: usize, response: E::Response<V>) {
        let (child, parent) = (attachment.child + at, attachment.parent + at);
        let (view, slots) = (self.view, self.view.slots);
        // SAFETY: see the top.
        let (constants, link) = unsafe { (self.constants(child), self.motion(parent, false)) };
        let own = E::attach(&constants, link, response);
        let mut sums = own;
        if !attachment.first {
            // SAFETY: see the top.
            sums = unsafe { read(view.sums.add(parent), slots) };
            add(&mut sums, &own);
        }
        // SAFETY: see the top.
        unsafe { write(&sums, view.sums.add(parent), slots) };
    }

    /// Writes the accelerations of the pivots of a strip.
    #[inline(always)]
    fn hand_down(&self, strip: &Strip) {
        let one = Passes::<E, N, T, V::One>::of(self.view);
        let (view, (from, to)) = (self.view, strip.attachments);
        for attachment in self.attachments.get(from..to).unwrap_or_default() {
            let mut at = 0;
            while at + V::LANES <= attachment.length {
                // SAFETY: see the top.
                let pivot = unsafe { self.pivot_at(attachment, at) };
                // SAFETY: see the top.
                unsafe {
                    write(
                        &pivot,
                        view.responses.add(attachment.child + at),
                        view.slots,
                    )
                };
                at += V::LANES;
            }
            while at < attachment.length {
                // SAFETY: see the top.
                let pivot = unsafe { one.pivot_at(attachment, at) };
                // SAFETY: see the top.
                unsafe {
                    write(
                        &pivot,
                        view.responses.add(attachment.child + at),
                        view.slots,
                    )
                };
                at += 1;
            }
        }
    }

    /// The accelerations of the pivots of children.
    #[inline(always)]
    unsafe fn pivot_at(&self, attachment: &Attachment, at: usize) -> [V; 2] {
        let (child, parent) = (attachment.child + at, attachment.parent + at);
        // SAFETY: see the top.
        let (constants, link) = unsafe { (self.constants(child), self.motion(parent, false)) };
        // SAFETY: see the top.
        let carried = unsafe { read(self.view.sums.add(parent), self.view.slots) };
        E::pivot(&constants, link, carried)
    }

    /// The motions of the links from `at` on, with those of joints where asked for.
    #[inline(always)]
    unsafe fn motion(&self, at: usize, joints: bool) -> LinkMotion<V> {
        let view = self.view;
        // SAFETY: see the top.
        let [sine, cosine]: [V; 2] = unsafe { read(view.sincos.add(at), view.links) };
        // SAFETY: see the top.
        let omega = unsafe { V::read(view.omega.add(at)) };
        let [joint_angle, joint_rate] = match joints {
            // SAFETY: see the top.
            true => unsafe { read(view.joint_motions.add(at), view.links) },
            false => [omega; 2],
        };
        LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
        }
    }

    /// The constants of the links from `at` on, each its own.
    #[inline(always)]
    unsafe fn constants(&self, at: usize) -> E::Constants<V> {
        let mut row = <E::Constants<V> as Row<V>>::filled(V::from_f64(0.0));
        let mut column = 0;
        while column < <E::Constants<V> as Row<V>>::LENGTH {
            // SAFETY: see the top.
            row.as_mut()[column] = unsafe { self.view.constant(column, at) };
            column += 1;
        }
        if at == 0 {
            self.take_torque(&mut row);
        }
        row
    }
}
