//! Links of a tree of any shape by their heights.

use alloc::vec::Vec;

/// The links, from the root on, by height: the distance to the deepest leaf below.
///
/// Among links of one height, those whose children have the same heights stand side by
/// side, and children in the order of their parents: the longer neighbours keep
/// together from strip to strip, the fewer attachments there are.
pub(super) struct Heights {
    /// The number of the link in each place.
    pub(super) order: Vec<u32>,
    /// The place of the parent of each of these; 0 for the root.
    pub(super) parents: Vec<u32>,
    /// Number of links of each height, from the root's down.
    pub(super) lengths: Vec<usize>,
}

impl Heights {
    /// Of the parents of all links, before which they stand; what is not before its
    /// link is taken for the link before it.
    pub(super) fn new(parents: &[u32]) -> Self {
        let parent = |link: usize| {
            let before = link.saturating_sub(1);
            parents
                .get(link)
                .map_or(0, |&parent| before.min(parent as usize))
        };
        let links = parents.len();
        let mut heights = alloc::vec![0_usize; links];
        let mut children: Vec<Vec<usize>> = alloc::vec![Vec::new(); links];
        for link in (1..links).rev() {
            let above = parent(link);
            heights[above] = heights[above].max(heights[link] + 1);
            children[above].push(link);
        }
        let mut kinds: Vec<Vec<usize>> = Vec::with_capacity(links);
        for children in &mut children {
            // The highest first, and of equal ones the first link.
            children.reverse();
            children.sort_by_key(|&child| core::cmp::Reverse(heights[child]));
            kinds.push(children.iter().map(|&child| heights[child]).collect());
        }
        let mut strips = alloc::vec![Vec::new(); heights.first().map_or(0, |&root| root + 1)];
        if let Some(top) = strips.last_mut() {
            top.push(0);
        }
        let (mut order, mut lengths) = (Vec::with_capacity(links), Vec::new());
        while let Some(mut strip) = strips.pop() {
            // Those with more children first: of parents side by side, all with another
            // child are the first ones then.
            strip.sort_by(|&one: &usize, &other: &usize| kinds[other].cmp(&kinds[one]));
            let most = strip.iter().map(|&link| children[link].len()).max();
            for number in 0..most.unwrap_or(0) {
                for &link in &strip {
                    if let Some(&child) = children[link].get(number) {
                        strips[heights[child]].push(child);
                    }
                }
            }
            lengths.push(strip.len());
            order.append(&mut strip);
        }
        let mut places = alloc::vec![0_u32; links];
        for (place, &link) in (0..).zip(&order) {
            places[link] = place;
        }
        Self {
            parents: order.iter().map(|&link| places[parent(link)]).collect(),
            order: order.iter().map(|&link| link as u32).collect(),
            lengths,
        }
    }
}
