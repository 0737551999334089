// A job type for Flamenco 3, to be put into the folder `scripts` beside flamenco-manager: simulates a scene, draws its
// frames in chunks, and makes the film. All workers need globular on PATH and see the same folders.
const JOB_TYPE = {
    label: "globular",
    settings: [
        { key: "scene", type: "string", subtype: "file_path", required: true, description: "scene file" },
        { key: "folder", type: "string", subtype: "dir_path", required: true,
          description: "folder for states, frames and film" },
        { key: "frames", type: "string", required: true, default: "0-119",
          description: "frames to draw, counted from 0, such as 0-30, 47" },
        { key: "chunk_size", type: "int32", default: 10, description: "frames of a task" },
        { key: "size", type: "string", default: "1280x720", description: "width and height in pixels" },
    ],
};

function taskOf(name, args) {
    const task = author.Task(name, "misc");
    task.addCommand(author.Command("exec", { exe: "globular", args: args }));
    return task;
}

function compileJob(job) {
    const settings = job.settings;
    const states = settings.folder + "/states";
    const frames = settings.folder + "/frames";

    const simulate = taskOf("simulate",
        ["simulate", settings.scene, "-o", states, "--frames", settings.frames, "--resume", "--quiet"]);
    job.addTask(simulate);

    const film = taskOf("film",
        ["assemble", frames, "--frames", settings.frames, "-o", settings.folder + "/film.mp4", "--quiet"]);
    for (const chunk of frameChunker(settings.frames, settings.chunk_size)) {
        const draw = taskOf("frames " + chunk,
            ["render", settings.scene, "--states", states, "-o", frames, "--size", settings.size,
             "--frames", chunk, "--chunk", "list", "--resume", "--quiet"]);
        draw.addDependency(simulate);
        film.addDependency(draw);
        job.addTask(draw);
    }
    job.addTask(film);
}
