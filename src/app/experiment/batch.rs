use std::num::NonZeroUsize;

use super::pool::{PoolEvent, pool};
use super::run::{EndedRun, make, make_apart, write};
use super::scratch::Scratch;
use super::store::merge;
use super::{Config, Outcome, Record, ResultsError, Run, Shard, Summary, summarise};

/// A set of experiments that are run together.
pub struct Batch<'a> {
    /// The experiments, in the order in which they are run.
    pub configs: &'a [Config],
    /// The shard of each experiment that is run.
    pub shard: Shard,
    /// Number of runs at the same time. Results do not depend on it.
    pub threads: NonZeroUsize,
    /// Makes the command that runs an experiment with a time limit in a process of its own. Without
    /// it, no limit holds.
    pub apart: Option<&'a Maker<'a>>,
    /// The folder of results, with the records of runs that an interrupted batch of the same
    /// program has finished. These runs are not made again.
    pub scratch: &'a Scratch,
}

/// The command that makes one run and writes its scratch record ([`make_one`](super::make_one)).
pub type Maker<'a> = dyn Fn(&Config, &Run) -> std::process::Command + Sync + 'a;

/// An event that a batch reports while it works.
pub enum Event<'a> {
    /// A run was finished by an earlier batch that was interrupted.
    Finished {
        /// Its config.
        config: &'a Config,
        /// The run.
        run: &'a Run,
        /// Its record.
        record: &'a Record,
    },
    /// A run begins.
    Begun {
        /// Its config.
        config: &'a Config,
        /// The run.
        run: &'a Run,
    },
    /// A run has ended; its record and pictures are written.
    Ended {
        /// Its config.
        config: &'a Config,
        /// The run.
        run: &'a Run,
        /// Its record.
        record: &'a Record,
        /// Its wall-clock time in seconds.
        seconds: f64,
    },
    /// The last run of a config has ended, and its records are summarised.
    Summed {
        /// The config.
        config: &'a Config,
        /// Its table and plots, or why there are none.
        summary: Result<&'a Summary, &'a ResultsError>,
    },
    /// A fifth of a second has passed, or all runs have ended.
    Pulse,
}

/// The indices of a config and of a run in it.
type Job = (usize, usize);

impl Batch<'_> {
    /// The runs of the shard whose data files exist.
    pub fn runs(&self) -> impl Iterator<Item = (&Config, &Run)> {
        self.jobs().into_iter().map(|job| self.of(job))
    }

    fn jobs(&self) -> Vec<Job> {
        let there = |run: &Run| run.data.as_ref().is_none_or(|data| data.path.is_some());
        let runs = |(c, config): (usize, &Config)| -> Vec<Job> {
            config.shard(self.shard).filter(|(_, run)| there(run)).map(|(r, _)| (c, r)).collect()
        };
        self.configs.iter().enumerate().flat_map(runs).collect()
    }

    fn of(&self, (config, run): Job) -> (&Config, &Run) {
        (&self.configs[config], &self.configs[config].runs[run])
    }

    /// Makes the runs and writes a record and pictures of each. Runs of configs with `alone = true`
    /// come last and one at a time. A config is summarised when its last run in this batch has
    /// ended. Once `stop` returns true, no run begins, and a run that fails counts as not made,
    /// because a terminal sends Ctrl-C also to programs that a run has started.
    ///
    /// # Errors
    /// [`ResultsError`] where files cannot be written.
    pub fn run(&self, stop: &(dyn Fn() -> bool + Sync), watch: &mut dyn FnMut(Event)) -> Result<(), ResultsError> {
        let jobs = self.unfinished(watch);
        let (mut unmade, mut unsummed) = (jobs.len(), 0);
        let mut left = vec![0; self.configs.len()];
        jobs.iter().for_each(|job| left[job.0] += 1);
        for (config, _) in self.configs.iter().zip(&left).filter(|(_, left)| **left == 0) {
            unsummed += usize::from(!self.sum_up(config, watch));
        }
        let (alone, together): (Vec<Job>, Vec<Job>) = jobs.into_iter().partition(|job| self.configs[job.0].alone);
        for (jobs, threads) in [(together, self.threads.get()), (alone, 1)] {
            let work = |item: usize| self.make(jobs[item], stop);
            pool(jobs.len(), threads, stop, &work, &mut |told| {
                match told {
                    PoolEvent::Pulse => watch(Event::Pulse),
                    PoolEvent::Begun(item) => {
                        let (config, run) = self.of(jobs[item]);
                        watch(Event::Begun { config, run });
                    }
                    PoolEvent::Ended(item, ended) => {
                        let (config, run) = self.of(jobs[item]);
                        let Some(EndedRun { record, seconds, .. }) = ended? else { return Ok(()) };
                        watch(Event::Ended { config, run, record: &record, seconds });
                        unmade -= 1;
                        left[jobs[item].0] -= 1;
                        if left[jobs[item].0] == 0 {
                            unsummed += usize::from(!self.sum_up(config, watch));
                        }
                    }
                }
                Ok::<_, ResultsError>(())
            })?;
        }
        // Where a key of a plot is misspelt the runs need not be made again.
        if unmade == 0 && unsummed == 0 { self.scratch.forget(self.configs, self.shard) } else { Ok(()) }
    }

    /// The runs to be made, after the finished ones have been reported.
    fn unfinished(&self, watch: &mut dyn FnMut(Event)) -> Vec<Job> {
        let mut jobs = self.jobs();
        jobs.retain(|job| {
            let (config, run) = self.of(*job);
            let Some(record) = self.scratch.finished(config, run) else { return true };
            watch(Event::Finished { config, run, record: &record });
            false
        });
        jobs
    }

    fn make(&self, job: Job, stop: &dyn Fn() -> bool) -> Result<Option<EndedRun>, ResultsError> {
        let (config, run) = self.of(job);
        if let (Some(seconds), Some(maker)) = (config.time_limit, self.apart) {
            return make_apart(self.scratch, config, run, (seconds, maker(config, run)), stop);
        }
        let ended = make(config, run);
        if ended.record.outcome == Outcome::Failed && stop() {
            return Ok(None);
        }
        write(self.scratch, config, run, &ended)?;
        Ok(Some(ended))
    }

    /// Merges and summarises the records of a config. Returns whether that succeeded; a config may
    /// have no records if data files are missing.
    fn sum_up(&self, config: &Config, watch: &mut dyn FnMut(Event)) -> bool {
        let summary = merge(config, self.scratch).and_then(|()| summarise(config, self.scratch.results()));
        match &summary {
            Ok(summary) if summary.records.is_empty() => {}
            Ok(summary) => watch(Event::Summed { config, summary: Ok(summary) }),
            Err(error) => watch(Event::Summed { config, summary: Err(error) }),
        }
        summary.is_ok()
    }
}
