//! Conversion of the description's nodes to templates.

use super::bodies::GivenProperties;
use super::names::check_link;
use super::passive::{PassiveTorques, check_idle};
use super::properties::Properties;
use super::rule::{Code, GenerationRule};
use super::template::{MAX_LINKS, Template, TreeBuilder, WholeRule};
use super::unequal::unequal_copies;
use super::{Offset, Quantity};
use crate::description::Node;
use crate::report::{Faults, SizeMessage, TreeMessage};

/// The parent of a link and the joint at which it hangs.
struct Parent {
    index: usize,
    joint: Offset,
}

impl TreeBuilder {
    /// Adds the root and all its descendants. After an error the templates have names and numbers
    /// of copies, but placeholder bodies.
    pub(super) fn add_root(&mut self, node: &Node, report: &mut Faults) {
        if let Some(copies) = node.copies.filter(|copies| copies.count > 1) {
            report.error(copies.span, TreeMessage::RootCopies);
        }
        self.add(node, None, report);
    }

    /// Adds a link or a rule, and its children: once for all copies, or for each copy if they
    /// differ.
    fn add(&mut self, node: &Node, parent: Option<&Parent>, report: &mut Faults) {
        // Stop here: the check of the tree's size will report it.
        if self.templates.len() > MAX_LINKS {
            return;
        }
        let before = report.diagnostics().len();
        check_link(&node.name, report);
        if let Some(copies) = node.copies.filter(|copies| copies.count == 0) {
            report.error(copies.span, TreeMessage::ZeroCopies);
        }
        if !node.damaged {
            check_idle(&node.properties, &node.name.to_string(), report);
        }
        let shape = node.shape.as_ref();
        let is_rule = shape.is_some_and(|shape| shape == "generations");
        let right = |report: &Faults| report.diagnostics().len() == before;
        let unequal = match right(report) {
            true => unequal_copies(node, is_rule, report),
            false => None,
        };
        let mut links = Vec::new();
        for copy in unequal.as_deref().unwrap_or(std::slice::from_ref(node)) {
            let (mut template, properties) = self.described(copy, is_rule, parent, report);
            template.name = node.name.to_string();
            template.node.clone_from(&template.name);
            links.push((template, properties));
            // Further copies would cause the same messages.
            if !right(report) {
                break;
            }
        }
        let differ = |pair: &[(Template, _)]| !pair[0].0.is_like(&pair[1].0);
        if !links.windows(2).any(differ) {
            links.truncate(1);
        }
        let (start, several) = (self.templates.len(), links.len() > 1);
        for (index, (mut template, properties)) in links.into_iter().enumerate() {
            if several {
                template.copies = 1;
                template.number = Some(index + 1);
            }
            let own = self.templates.len();
            self.add_link(node, template, &properties, report);
            for later in own..self.templates.len() {
                let first = self.templates.get(later - own + start);
                if let Some(origin) = first.map(|first| first.origin) {
                    self.templates[later].origin = origin;
                }
            }
            if !right(report) {
                break;
            }
        }
    }

    /// Creates the template of a link, without its children.
    fn described(
        &mut self,
        node: &Node,
        is_rule: bool,
        parent: Option<&Parent>,
        report: &mut Faults,
    ) -> (Template, Properties) {
        let properties = Properties::read(node, is_rule, &mut self.values, report);
        let template = Template {
            name: node.name.to_string(),
            node: node.name.to_string(),
            span: node.name.span(),
            parent: parent.map(|parent| parent.index),
            copies: node.copies.map_or(1, |copies| copies.count as usize),
            number: None,
            origin: self.templates.len(),
            body: properties.body.clone(),
            pivot: self.pivot(node, parent, &properties.given, report),
            passive: PassiveTorques::of(&properties.given),
        };
        (template, properties)
    }

    /// Adds a link or a rule with known properties, and its children.
    fn add_link(
        &mut self,
        node: &Node,
        mut first: Template,
        properties: &Properties,
        report: &mut Faults,
    ) {
        first.origin = self.templates.len();
        if let Some(rule) = &properties.rule {
            match first.parent {
                None => {
                    self.whole = Some(WholeRule {
                        branching: rule.branching,
                        code: rule.code,
                        span: first.span,
                        open: rule.open.then_some(rule.count),
                    });
                }
                Some(_) if rule.open => {
                    let needs = "a rule that describes the whole tree";
                    report.error(first.span, TreeMessage::OpenBranching { needs });
                }
                Some(_) if rule.code == Some(Code::Loops) => {
                    let what = "a rule below other links".to_owned();
                    report.error(first.span, SizeMessage::NoLoops { what });
                }
                Some(_) => {}
            }
            if let Some(child) = node.children.first() {
                report.error(child.name.span(), TreeMessage::RuleChildren);
            }
            self.add_generations(node, first, properties, rule, report);
            return;
        }
        let joint = first.body.joint.clone();
        let names_pivot = |child: &Node| child.properties.iter().any(|p| p.name == "at");
        if joint.is_none() && !node.damaged && !node.children.iter().all(names_pivot) {
            missing_joint(node, report);
        }
        let parent = Parent {
            index: self.templates.len(),
            joint: joint.unwrap_or_else(origin),
        };
        self.templates.push(first);
        for child in &node.children {
            self.add(child, Some(&parent), report);
        }
    }

    /// Evaluates the pivot of a link on its parent.
    fn pivot(
        &self,
        node: &Node,
        parent: Option<&Parent>,
        given: &GivenProperties,
        report: &mut Faults,
    ) -> Offset {
        match (parent, given.point("at")) {
            (Some(_), Some(at)) => at.clone(),
            (Some(parent), None) => parent.joint.clone(),
            (None, None) => origin(),
            (None, Some(_)) => {
                let at = node.properties.iter().find(|p| p.name == "at");
                let span = at.map_or(node.name.span(), |at| at.name.span());
                report.error(span, TreeMessage::RootPivot);
                origin()
            }
        }
    }

    /// Adds all generations of a rule; `first` is the template of the first one.
    fn add_generations(
        &mut self,
        node: &Node,
        first: Template,
        properties: &Properties,
        rule: &GenerationRule,
        report: &mut Faults,
    ) {
        let span = first.span;
        // The number of templates alone may be too large, even without copies.
        if self.templates.len().saturating_add(rule.count) > MAX_LINKS {
            report.error(span, SizeMessage::TooManyLinks { limit: MAX_LINKS });
            return;
        }
        if first.body.joint.is_none() && rule.count > 1 && !node.damaged {
            missing_joint(node, report);
        }
        for generation in 0..rule.count {
            let values = &mut self.values;
            let found = properties.of_generation(generation, node, values, report);
            let Some((body, given)) = found else {
                return;
            };
            let above = generation.checked_sub(1).map(|_| self.templates.len() - 1);
            let is_open = rule.open && above.is_some();
            let hanging = above.and_then(|above| self.templates.get(above)?.body.joint.clone());
            self.templates.push(Template {
                name: format!("{}_{}", first.name, generation + 1),
                node: first.node.clone(),
                span,
                parent: above.or(first.parent),
                copies: match above {
                    Some(_) if is_open => 1,
                    Some(_) => rule.branching,
                    None => first.copies,
                },
                number: is_open.then_some(1),
                origin: self.templates.len(),
                body,
                pivot: hanging.unwrap_or_else(|| first.pivot.clone()),
                passive: PassiveTorques::of(&given),
            });
        }
        if rule.open {
            self.add_closed(rule.count);
        }
    }

    /// Adds the closed siblings of the open links, whose path of `generations` templates is the
    /// last that was added. All links of one generation below a closed sibling move in phase, and
    /// become one link with their total mass, inertia and passive torques.
    fn add_closed(&mut self, generations: usize) {
        let root = self.templates.len() - generations;
        for branching in (1..generations).rev() {
            let mut parent = root + branching - 1;
            for generation in branching..generations {
                let (own, copies) = (
                    &self.templates[root + generation],
                    1 << (generation - branching),
                );
                let mut closed = Template {
                    name: own.name.clone(),
                    node: own.node.clone(),
                    parent: Some(parent),
                    number: (generation == branching).then_some(2),
                    body: own.body.clone(),
                    pivot: own.pivot.clone(),
                    passive: own.passive.clone(),
                    ..*own
                };
                closed.take_copies(copies);
                parent = self.templates.len();
                self.templates.push(closed);
            }
        }
    }
}

fn missing_joint(node: &Node, report: &mut Faults) {
    let link = node.name.to_string();
    report.error(node.name.span(), TreeMessage::MissingJoint { link });
}

/// Returns the point at the pivot itself, the origin of the link's frame.
fn origin() -> Offset {
    Offset {
        along: Quantity::zero(),
        lateral: Quantity::zero(),
    }
}
