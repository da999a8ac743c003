//! The pebble game of bodies in the plane.
//!
//! A body has three pebbles, a pin that joins three or more bodies is a vertex of its own with two.
//! A constraint is independent of those before it exactly if four pebbles can be gathered at its
//! ends; it is then covered by one of them (Lee & Streinu, *Pebble game algorithms and sparse
//! graphs*, Discrete Math. 308 (2008), with l = 3). For bodies and pins in generic position the
//! count is exact (Tay 1984, Whiteley 1988; pins of many bodies: Jackson & Jordán 2008).

/// Pebbles that a constraint's ends must hold for it to be independent.
const NEEDED: usize = 4;

/// Vertices with their pebbles; each covered constraint points from the vertex that pays for it.
#[derive(Clone, Debug)]
pub(super) struct Pebbles {
    free: Vec<usize>,
    /// Where the constraints that a vertex pays for lead.
    paid: Vec<Vec<usize>>,
}

impl Pebbles {
    pub(super) fn new(pebbles: Vec<usize>) -> Pebbles {
        Pebbles {
            paid: vec![Vec::new(); pebbles.len()],
            free: pebbles,
        }
    }

    /// Adds a constraint; if it is redundant, the vertices that are rigid without it.
    pub(super) fn insert(&mut self, a: usize, b: usize) -> Result<(), Vec<usize>> {
        while self.free[a] + self.free[b] < NEEDED {
            if !(self.fetch(a, &[a, b]) || self.fetch(b, &[a, b])) {
                return Err(self.reached(&[a, b]));
            }
        }
        // With four pebbles at both ends and at most three at one each has some.
        self.free[a] -= 1;
        self.paid[a].push(b);
        Ok(())
    }

    /// Brings a free pebble from anywhere but the vertices of `held`, `to` among them, to `to`.
    fn fetch(&mut self, to: usize, held: &[usize]) -> bool {
        let n = self.free.len();
        let mut from = vec![usize::MAX; n];
        let mut seen = vec![false; n];
        held.iter().for_each(|&v| seen[v] = true);
        let mut stack = vec![to];
        while let Some(v) = stack.pop() {
            if v != to && self.free[v] > 0 {
                self.reverse(&from, to, v);
                return true;
            }
            for &w in &self.paid[v] {
                if !seen[w] {
                    (seen[w], from[w]) = (true, v);
                    stack.push(w);
                }
            }
        }
        false
    }

    /// Every vertex on the way from `to` to `v` pays for one constraint less and the next for it.
    fn reverse(&mut self, from: &[usize], to: usize, mut v: usize) {
        self.free[v] -= 1;
        while v != to {
            let u = from[v];
            if let Some(k) = self.paid[u].iter().position(|&w| w == v) {
                self.paid[u].swap_remove(k);
            }
            self.paid[v].push(u);
            v = u;
        }
        self.free[to] += 1;
    }

    /// All vertices that can be reached over constraints paid for.
    fn reached(&self, from: &[usize]) -> Vec<usize> {
        let mut seen = vec![false; self.free.len()];
        let mut stack = from.to_vec();
        while let Some(v) = stack.pop() {
            if !std::mem::replace(&mut seen[v], true) {
                stack.extend(&self.paid[v]);
            }
        }
        (0..seen.len()).filter(|&v| seen[v]).collect()
    }

    /// Freedoms against a body that is held.
    pub(super) fn freedoms(&self) -> usize {
        self.free.iter().sum::<usize>() - (NEEDED - 1)
    }

    /// Holds a body: all its pebbles are free. The vertices that can move against it.
    pub(super) fn hold(&mut self, body: usize) -> Vec<usize> {
        while self.fetch(body, &[body]) {}
        (0..self.free.len())
            .filter(|&v| v != body)
            .filter(|&v| {
                let mut trial = self.clone();
                trial.free[v] > 0 || trial.fetch(v, &[body, v])
            })
            .collect()
    }

    /// Where the constraints that each vertex pays for lead.
    pub(super) fn paid(&self) -> &[Vec<usize>] {
        &self.paid
    }
}

/// The strongly connected components of a graph, each after those that it leads to (Tarjan 1972).
pub(super) fn components(edges: &[Vec<usize>]) -> Vec<Vec<usize>> {
    struct Search<'a> {
        edges: &'a [Vec<usize>],
        index: Vec<Option<usize>>,
        low: Vec<usize>,
        stack: Vec<usize>,
        on_stack: Vec<bool>,
        next: usize,
        found: Vec<Vec<usize>>,
    }
    fn visit(s: &mut Search, v: usize) {
        s.index[v] = Some(s.next);
        s.low[v] = s.next;
        s.next += 1;
        s.stack.push(v);
        s.on_stack[v] = true;
        for &w in &s.edges[v] {
            match s.index[w] {
                None => {
                    visit(s, w);
                    s.low[v] = s.low[v].min(s.low[w]);
                }
                Some(i) if s.on_stack[w] => s.low[v] = s.low[v].min(i),
                Some(_) => {}
            }
        }
        if s.index[v] == Some(s.low[v]) {
            let mut component = Vec::new();
            while let Some(w) = s.stack.pop() {
                s.on_stack[w] = false;
                component.push(w);
                if w == v {
                    break;
                }
            }
            component.sort_unstable();
            s.found.push(component);
        }
    }
    let n = edges.len();
    let mut search = Search {
        edges,
        index: vec![None; n],
        low: vec![0; n],
        stack: Vec::new(),
        on_stack: vec![false; n],
        next: 0,
        found: Vec::new(),
    };
    for v in 0..n {
        if search.index[v].is_none() {
            visit(&mut search, v);
        }
    }
    search.found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cycle of `n` bodies, two constraints between neighbours.
    fn ring(n: usize) -> Result<Pebbles, Vec<usize>> {
        let mut game = Pebbles::new(vec![3; n]);
        for k in 0..n {
            game.insert(k, (k + 1) % n)?;
            game.insert(k, (k + 1) % n)?;
        }
        Ok(game)
    }

    #[test]
    fn rings_of_pins() {
        // Three bars are a triangle; four have one freedom, five two.
        for (n, freedoms) in [(3, 0), (4, 1), (5, 2)] {
            assert_eq!(ring(n).unwrap().freedoms(), freedoms);
        }
        // Two bodies on two pins hold one another once too often.
        assert_eq!(ring(2).unwrap_err(), [0, 1]);
    }

    #[test]
    fn what_is_rigid_is_named() {
        let mut game = ring(4).unwrap();
        game.insert(0, 2).unwrap();
        assert_eq!(game.freedoms(), 0);
        assert_eq!(game.insert(1, 3).unwrap_err(), [0, 1, 2, 3]);
        // With 0 fixed to 2, a triangle on three more bars.
        let mut six = ring(6).unwrap();
        six.insert(0, 2).unwrap();
        six.insert(0, 2).unwrap();
        assert_eq!(six.insert(0, 1).unwrap_err(), [0, 1, 2]);
        assert_eq!(six.hold(0), [3, 4, 5]);
    }

    /// With any body held all others that move are told, those joined to it among them, and with
    /// none free no one.
    #[test]
    fn any_body_may_be_held() {
        for n in 4..7 {
            for body in 0..n {
                let others: Vec<usize> = (0..n).filter(|&v| v != body).collect();
                let mut game = ring(n).unwrap();
                assert_eq!(game.hold(body), others);
                assert_eq!(game.freedoms(), n - 3);
            }
        }
        for body in 0..3 {
            assert!(ring(3).unwrap().hold(body).is_empty());
        }
    }

    /// The constraints that each vertex pays for and its pebbles are always as many as it was
    /// given.
    #[test]
    fn no_pebble_is_lost() {
        for (given, pairs) in [
            (
                vec![3, 3, 3, 3],
                vec![(0, 1), (0, 1), (1, 2), (2, 1), (2, 3), (3, 2), (0, 3)],
            ),
            (
                vec![3, 3, 3, 2],
                vec![(0, 3), (3, 0), (1, 3), (3, 1), (2, 3), (3, 2), (0, 1)],
            ),
            (vec![2, 3], vec![(0, 1), (1, 0)]),
        ] {
            let mut game = Pebbles::new(given.clone());
            for (a, b) in pairs {
                assert_eq!(game.insert(a, b), Ok(()), "{a} {b}");
                let held = game.free.iter().zip(&game.paid).map(|(f, p)| f + p.len());
                assert_eq!(held.collect::<Vec<_>>(), given);
            }
        }
    }

    #[test]
    fn components_come_after_what_they_lead_to() {
        let edges = vec![vec![1], vec![2], vec![1, 3], vec![], vec![0, 3]];
        assert_eq!(components(&edges), [vec![3], vec![1, 2], vec![0], vec![4]]);
    }
}
