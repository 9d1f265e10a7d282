use std::num::NonZeroUsize;

use super::pool::{PoolEvent, pool};
use super::run::{EndedRun, make, make_apart, write};
use super::scratch::Scratch;
use super::store::merge;
use super::{Config, Outcome, Record, ResultsError, Run, Shard, Summary, summarise};

/// Experiments to be run together.
pub struct Batch<'a> {
    /// In this order.
    pub configs: &'a [Config],
    /// Of each of them.
    pub shard: Shard,
    /// Runs made at the same time. What comes out does not depend on it.
    pub threads: NonZeroUsize,
    /// How a run is made in a process of its own, where its config limits its time. Without, the limit does not hold.
    pub apart: Option<&'a Maker<'a>>,
    /// The folder of results, with the records of runs that an interrupted batch of the same program has finished. These
    /// runs are not made again.
    pub scratch: &'a Scratch,
}

/// The command that makes one run and writes its scratch record ([`make_one`](super::make_one)).
pub type Maker<'a> = dyn Fn(&Config, &Run) -> std::process::Command + Sync + 'a;

/// What a batch tells while it works.
pub enum Event<'a> {
    /// A run was finished before the interruption of a former batch.
    Finished {
        /// Its config.
        config: &'a Config,
        /// The run.
        run: &'a Run,
        /// What it left behind.
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
        /// What it left behind.
        record: &'a Record,
        /// Wall-clock seconds that it took.
        seconds: f64,
    },
    /// The last run of a config has ended, and its records are summed up.
    Summed {
        /// The config.
        config: &'a Config,
        /// Its table and plots, or why there are none.
        summary: Result<&'a Summary, &'a ResultsError>,
    },
    /// Time passes.
    Pulse,
}

/// A run by the places of its config and of itself therein.
type Job = (usize, usize);

impl Batch<'_> {
    /// The runs of the shard whose data are there.
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

    /// Makes the runs, each with a record and pictures in `results`; those of configs that are to run alone come last and
    /// one at a time. A config is summed up when its last run here has ended. Where `stop` says so, no more runs are begun,
    /// and what fails from then on counts as not made: the Ctrl-C of a terminal reaches programs that a run calls, too.
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

    /// What is to be made, after what is finished has been told.
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

    /// Whether it could be done. Nothing is made of nothing: data may not be here.
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
