//! Running firmware in QEMU.

use crate::elf::Elf;
use crate::process;
use anyhow::{bail, ensure, Context, Result};
use serde_json::{json, Value};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{channel, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

/// An emulated board.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Machine {
    program: &'static str,
    arguments: &'static [&'static str],
}

/// Arm's MPS2 with a Cortex-M3, which runs the code of a Cortex-M0+ as well.
pub(crate) const MPS2_M3: Machine = Machine { program: "qemu-system-arm", arguments: &["-M", "mps2-an385"] };
/// Arm's MPS2 with a Cortex-M4F.
pub(crate) const MPS2_M4: Machine = Machine { program: "qemu-system-arm", arguments: &["-M", "mps2-an386"] };
/// RISC-V without firmware of its own.
pub(crate) const VIRT: Machine = Machine { program: "qemu-system-riscv32", arguments: &["-M", "virt", "-bios", "none"] };
/// TI's Stellaris board with a Cortex-M3 and an OLED.
pub(crate) const LM3S6965: Machine = Machine { program: "qemu-system-arm", arguments: &["-M", "lm3s6965evb"] };

/// The version of the QEMU that is installed: its first two numbers.
///
/// # Errors
/// If there is none.
pub(crate) fn version() -> Result<(u32, u32)> {
    let text = process::output(Command::new(MPS2_M3.program).arg("--version"))?;
    let number = text.split_whitespace().skip_while(|word| *word != "version").nth(1);
    let mut parts = number.unwrap_or_default().split('.').map_while(|part| part.parse().ok());
    parts.next().zip(parts.next()).with_context(|| format!("no version in {:?}", text.lines().next()))
}

/// A running emulator. It ends when this is dropped.
pub(crate) struct Emulator {
    child: Child,
    /// What the firmware says by semihosting, line by line.
    lines: Receiver<String>,
    /// Until when all must be done.
    deadline: Instant,
}

impl Emulator {
    /// Starts firmware on a board. `options` are QEMU's; `words` are the firmware's, which it may ask for by semihosting.
    ///
    /// # Errors
    /// If QEMU does not start.
    pub(crate) fn start(machine: Machine, elf: &Elf, options: &[String], words: &[String], limit: Duration) -> Result<Emulator> {
        let mut semihosting = String::from("enable=on,target=native,chardev=out");
        for word in words {
            semihosting += &format!(",arg={word}");
        }
        let mut command = Command::new(machine.program);
        command.args(machine.arguments).args(["-display", "none", "-monitor", "none", "-serial", "null"]);
        command.args(["-chardev", "stdio,id=out,signal=off", "-semihosting-config", &semihosting]);
        command.args(options).arg("-kernel").arg(elf.path());
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().with_context(|| machine.program)?;

        let output = child.stdout.take().context("QEMU has no output")?;
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Ok(Emulator { child, lines, deadline: Instant::now() + limit })
    }

    /// The next line that the firmware says; none once it has ended.
    ///
    /// # Errors
    /// If the time is up.
    pub(crate) fn line(&mut self) -> Result<Option<String>> {
        match self.lines.recv_timeout(self.deadline.saturating_duration_since(Instant::now())) {
            Ok(line) => Ok(Some(line)),
            Err(RecvTimeoutError::Disconnected) => Ok(None),
            Err(RecvTimeoutError::Timeout) => bail!("the firmware took too long"),
        }
    }

    /// All that the firmware says until it ends.
    ///
    /// # Errors
    /// If the time is up, or the firmware ends in another way than with success.
    pub(crate) fn finish(mut self) -> Result<String> {
        let mut text = String::new();
        while let Some(line) = self.line()? {
            text += &line;
            text.push('\n');
        }
        let status = self.child.wait()?;
        let mut complaints = String::new();
        if let Some(mut stderr) = self.child.stderr.take() {
            stderr.read_to_string(&mut complaints)?;
        }
        ensure!(status.success(), "the firmware failed ({status})\n{text}{complaints}");
        Ok(text)
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// An option's value with its commas doubled, as QEMU wants them.
pub(crate) fn escaped(path: &Path) -> String {
    path.display().to_string().replace(',', ",,")
}

/// Where an emulator calls back to be controlled.
pub(crate) struct Exchange {
    listener: TcpListener,
}

impl Exchange {
    /// Listens on this machine alone.
    ///
    /// # Errors
    /// If no port is free.
    pub(crate) fn open() -> Result<Exchange> {
        Ok(Exchange { listener: TcpListener::bind((Ipv4Addr::LOCALHOST, 0))? })
    }

    /// The options that make QEMU call.
    ///
    /// # Errors
    /// If the port is lost.
    pub(crate) fn options(&self) -> Result<Vec<String>> {
        Ok(vec!["-qmp".into(), format!("tcp:{},server=off", self.listener.local_addr()?)])
    }

    /// Takes the call of an emulator started with [`Exchange::options`]; it calls before it runs anything.
    ///
    /// # Errors
    /// If it talks nonsense.
    pub(crate) fn answer(self) -> Result<Control> {
        let mut control = Control { stream: BufReader::new(self.listener.accept()?.0) };
        control.message()?; // the greeting
        control.execute("qmp_capabilities", json!({}))?;
        Ok(control)
    }
}

/// An emulator's remote control (QMP).
pub(crate) struct Control {
    stream: BufReader<TcpStream>,
}

impl Control {
    /// Saves what the machine's display shows, as a PPM.
    ///
    /// # Errors
    /// If QEMU cannot.
    pub(crate) fn screenshot(&mut self, path: &Path) -> Result<()> {
        self.execute("screendump", json!({ "filename": path }))
    }

    fn execute(&mut self, command: &str, arguments: Value) -> Result<()> {
        writeln!(self.stream.get_mut(), "{}", json!({ "execute": command, "arguments": arguments }))?;
        loop {
            let message = self.message()?;
            if let Some(error) = message.get("error") {
                bail!("QEMU: {command}: {error}");
            }
            // Anything else is an event.
            if message.get("return").is_some() {
                return Ok(());
            }
        }
    }

    fn message(&mut self) -> Result<Value> {
        let mut line = String::new();
        ensure!(self.stream.read_line(&mut line)? > 0, "QEMU hung up");
        Ok(serde_json::from_str(&line)?)
    }
}
