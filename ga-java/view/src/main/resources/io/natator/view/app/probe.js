/** What tests read of a page. */

/** Figures of what is shown: of the first view, or of `views[1]`. */
export function figures(page) {
  const of = which => ({
    frame: () => page.views[which]?.frame?.frame ?? -1,
    time: () => page.views[which]?.frame?.time ?? 0,
    distance: () => page.views[which]?.frame?.distance ?? 0,
    fps: () => page.views[which]?.fps ?? 0,
    pace: () => page.views[which]?.pace ?? 0,
    dropped: () => page.views[which]?.dropped ?? 0,
    drawing: () => page.views[which]?.stage.drawing ?? '',
    share: () => page.views[which]?.stage.share ?? 0,
    hasWake: () => page.views[which]?.stage.hasWake ?? false,
    forces: () => page.views[which]?.stage.forces ?? [],
    samples: () => page.views[which]?.stage.samples ?? 0,
    scene: () => page.views[which]?.scene ?? null,
    connected: () => page.views[which]?.isConnected ?? false,
    position: () => Array.from(page.views[which]?.frame?.position ?? []),
  });
  return {...of(0), views: [of(0), of(1)]};
}
